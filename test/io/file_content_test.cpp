#include "monocular_eye_hand/io/file_content.h"

#include <gtest/gtest.h>

#include "monocular_eye_hand/io/plain_number.h"

namespace monocular_eye_hand {
namespace {

std::string wide(const std::string& text, bool little) {
  std::string out;
  for (const char c : text) out += little ? std::string{c, '\0'} : std::string{'\0', c};
  return out;
}

TEST(FileContent, NamesWhatItKnows) {
  const auto named = [](const std::string& bytes, const std::string& word) {
    EXPECT_NE(foreignContent(bytes).find(word), std::string::npos) << bytes << ": " << foreignContent(bytes);
  };
  named("version https://git-lfs.github.com/spec/v1\n", "git lfs pull");
  named("/annex/objects/SHA256E-s1--00.stl\n", "git annex get");
  named("ISO-10303-21;\nHEADER;\n", "STEP");
  named("\xef\xbb\xbf\n  ISO-10303-21;", "STEP");
  named("PK\x03\x04rest", "ZIP");
  named("\x1f\x8b\x08", "gzip");
  named("<!DOCTYPE HTML>", "web page");
  named("glTF\x02", "glTF");
  named("# .PCD v0.7", "point cloud");
  named(std::string(72, ' ') + "S      1\n", "IGES");
  EXPECT_EQ(foreignContent("solid part\n"), "");
  EXPECT_EQ(foreignContent("ply\n"), "");
  EXPECT_EQ(foreignContent(""), "");
}

TEST(FileContent, Utf16BecomesUtf8) {
  const std::string text = "solid caf\xc3\xa9\n";
  for (const bool little : {true, false}) {
    std::string bytes = wide("solid caf", little);
    bytes += little ? std::string("\xe9\0", 2) : std::string("\0\xe9", 2);
    bytes += wide("\n", little);
    EXPECT_EQ(plainText(bytes).text, text);
    EXPECT_EQ(plainText((little ? "\xff\xfe" : "\xfe\xff") + bytes).text, text);
    EXPECT_EQ(plainText(bytes).warnings.size(), 1u);
  }
}

TEST(FileContent, PlainTextStaysAsItIs) {
  EXPECT_EQ(plainText("solid a\n").text, "solid a\n");
  EXPECT_TRUE(plainText("solid a\n").warnings.empty());
  EXPECT_EQ(plainText("\xef\xbb\xbfsolid").text, "solid");
  EXPECT_EQ(withLineFeeds("a\r\nb\rc\n\r"), "a\nb\nc\n\n");
}

TEST(PlainNumber, HasNoExponent) {
  EXPECT_EQ(plainNumber(140000), "140000");
  EXPECT_EQ(plainNumber(1234.6), "1235");
  EXPECT_EQ(plainNumber(80), "80");
  EXPECT_EQ(plainNumber(2.5), "2.5");
  EXPECT_EQ(plainNumber(0.08), "0.08");
  EXPECT_EQ(plainNumber(0.00008), "0.00008");
  EXPECT_EQ(plainNumber(-0.25), "-0.25");
  EXPECT_EQ(plainNumber(0), "0");
}

TEST(FileContent, TextIsNeverCalledBinary) {
  EXPECT_FALSE(looksBinary("solid \xe9t\xe9\r\n\tfacet\f\x1a"));
  EXPECT_FALSE(looksBinary(""));
  EXPECT_TRUE(looksBinary(std::string("solid\0", 6)));
}

}  // namespace
}  // namespace monocular_eye_hand
