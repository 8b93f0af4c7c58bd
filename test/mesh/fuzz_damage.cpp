#include "fuzz_damage.h"

#include <algorithm>
#include <cstring>

namespace monocular_eye_hand::fuzz {
namespace {

constexpr size_t kLargest = 200000;  // bytes: more takes time and shows nothing new

const std::vector<std::string> kNumbers = {"0",
                                           "-1",
                                           "1",
                                           "-0",
                                           "3.0",
                                           "4294967295",
                                           "4294967296",
                                           "2147483647",
                                           "2147483648",
                                           "-2147483649",
                                           "1e999",
                                           "-1e999",
                                           "nan",
                                           ".nan",
                                           "inf",
                                           "-.inf",
                                           "1e308",
                                           "1e-320",
                                           "1,5",
                                           "0x10",
                                           "1e10",
                                           "99999999999999999999999",
                                           "",
                                           "-",
                                           "1e",
                                           "007",
                                           "1.5.2",
                                           "200000001",
                                           "18446744073709551615"};

// Words that mean something in one of the formats, where they do not belong.
const std::vector<std::string> kWords = {"&a [*a]",
                                         "&a {b: *a}",
                                         "*a",
                                         "&a",
                                         "<<: *a",
                                         "!!binary x",
                                         "? ",
                                         "- ",
                                         "[",
                                         "{",
                                         "}",
                                         "]",
                                         ": ",
                                         "|",
                                         ">",
                                         "%YAML:1.0\n",
                                         "---\n",
                                         "...\n",
                                         "\t",
                                         "#",
                                         "\"",
                                         "'",
                                         "~",
                                         "data",
                                         "objects:",
                                         "opencv-matrix",
                                         "<!--",
                                         "-->",
                                         "<![CDATA[",
                                         "]]>",
                                         "&#0;",
                                         "&lt;",
                                         "<?",
                                         "<",
                                         ">",
                                         "/>",
                                         "</",
                                         "<p>",
                                         "</p>",
                                         "<vcount>",
                                         "<triangles>",
                                         "<polylist>",
                                         "<input semantic=\"VERTEX\" source=\"#v\" offset=\"9\"/>",
                                         "#g",
                                         "<camera>",
                                         "<!DOCTYPE a [<!ENTITY b \"&b;&b;\">]>",
                                         "\nf 1/1/1 2//2 3\n",
                                         "\nf -1 -2 -3\n",
                                         "\nf 1 1 1 1 1 1\n",
                                         "\nusemtl a\n",
                                         "\nmtllib no.mtl\n",
                                         "\ng\n",
                                         "\no\n",
                                         "\nl 1 2\n",
                                         "\np 1\n",
                                         "\nvp 1 2\n",
                                         "\\\n",
                                         "\nvn 0 0\n",
                                         "\nsolid a\n",
                                         "\nendsolid\n",
                                         "\nfacet normal 0 0 1\n",
                                         "\nouter loop\n",
                                         "\nendloop\n",
                                         "vertex",
                                         "\nelement face 4000000000\n",
                                         "\nproperty list uchar int vertex_indices\n",
                                         "\nend_header\n",
                                         "\nply\n",
                                         "\nproperty list float float x\n",
                                         "\nformat ascii 1.0\n",
                                         "[image]\n",
                                         "camera matrix\n",
                                         "package://",
                                         "${HOME}",
                                         "$(find a)",
                                         "file://",
                                         "../",
                                         "/"};

bool isNumberSign(char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+'; }

/// A piece of the file: where it begins, and its length.
struct Piece {
  size_t at, length;
};

Piece somePiece(const std::string& file, Dice* dice) {
  const size_t at = dice->below(file.size() + 1);
  const size_t max_bytes = dice->oneIn(3) ? file.size() - at : std::min<size_t>(file.size() - at, 64);
  return {at, dice->below(max_bytes + 1)};
}

Piece someLine(const std::string& file, Dice* dice) {
  const size_t at = dice->below(file.size() + 1),
               before = at == 0 ? std::string::npos : file.rfind('\n', at - 1);
  const size_t begin = before == std::string::npos ? 0 : before + 1,
               end = std::min(file.find('\n', at), file.size());
  return {begin, std::min(end + 1, file.size()) - begin};
}

/// The number nearest behind a random place; of length 0 when there is none.
Piece someNumber(const std::string& file, Dice* dice) {
  size_t begin = dice->below(file.size() + 1);
  while (begin < file.size() && !isNumberSign(file[begin])) ++begin;
  size_t end = begin;
  while (end < file.size() && isNumberSign(file[end])) ++end;
  return {begin, end - begin};
}

void flipBits(std::string* file, Dice* dice) {
  if (file->empty()) return;
  for (size_t n = 1 + dice->below(8); n > 0; --n)
    (*file)[dice->below(file->size())] ^= char(1 << dice->below(8));
}

void overwriteByte(std::string* file, Dice* dice) {
  static const std::string kSigns("\0\xff\r\n\t \"<>[]{}&*:,-#/\\\x7f\x80", 23);
  if (!file->empty()) (*file)[dice->below(file->size())] = kSigns[dice->below(kSigns.size())];
}

/// A count, an index or a coordinate of a binary file.
void overwriteNumber(std::string* file, Dice* dice) {
  static const std::vector<uint64_t> kBits = {
      0,          1,          0xffffffffffffffff, 0x7fffffff,        0x80000000,
      0x7fc00000, 0x7f800000, 0xff800000,         0x7f7fffff,        0x00000001,
      0x3b9aca00, 0xff,       0x7ff8000000000000, 0x7fefffffffffffff};
  const uint64_t bits = dice->of(kBits);
  const size_t size = size_t(1) << dice->below(4);
  if (file->size() < size) return;
  size_t at = dice->below(file->size() - size + 1);
  if (dice->oneIn(4) && file->size() >= 88) at = 80;  // the count of a binary STL
  std::memcpy(&(*file)[at], &bits, std::min(size, file->size() - at));
}

void cutOff(std::string* file, Dice* dice) { file->resize(dice->below(file->size() + 1)); }

void removePiece(std::string* file, Dice* dice) {
  const Piece piece = dice->oneIn(2) ? someLine(*file, dice) : somePiece(*file, dice);
  file->erase(piece.at, piece.length);
}

void repeatPiece(std::string* file, Dice* dice) {
  const Piece piece = dice->oneIn(2) ? someLine(*file, dice) : somePiece(*file, dice);
  const std::string text = file->substr(piece.at, piece.length);
  std::string all;
  for (size_t n = dice->oneIn(8) ? 1 + dice->below(3000) : 1 + dice->below(3); n > 0; --n) {
    if (all.size() > kLargest) break;
    all += text;
  }
  file->insert(piece.at, all);
}

void movePiece(std::string* file, Dice* dice) {
  const Piece piece = dice->oneIn(2) ? someLine(*file, dice) : somePiece(*file, dice);
  const std::string text = file->substr(piece.at, piece.length);
  file->erase(piece.at, piece.length);
  file->insert(dice->below(file->size() + 1), text);
}

void replaceNumber(std::string* file, Dice* dice) {
  const Piece piece = someNumber(*file, dice);
  file->replace(piece.at, piece.length, dice->of(kNumbers));
}

void insertWord(std::string* file, Dice* dice) {
  const std::string& word = dice->of(kWords);
  std::string all;
  // Readers that call themselves for what is nested must not run out of stack.
  for (size_t n = dice->oneIn(8) ? 1 + dice->below(20000) : 1; n > 0 && all.size() < kLargest; --n)
    all += word;
  const Piece number = someNumber(*file, dice);
  if (dice->oneIn(3)) {
    file->replace(number.at, number.length, all);
  } else {
    file->insert(dice->below(file->size() + 1), all);
  }
}

void splice(std::string* file, const std::vector<std::string>& others, Dice* dice) {
  const std::string& other = dice->of(others);
  if (dice->oneIn(2)) {
    *file = file->substr(0, dice->below(file->size() + 1)) + other.substr(dice->below(other.size() + 1));
  } else {
    const Piece piece = somePiece(other, dice);
    file->insert(dice->below(file->size() + 1), other.substr(piece.at, piece.length));
  }
}

std::string wide(const std::string& file, bool little) {
  std::string out;
  for (const char c : file) out += little ? std::string{c, '\0'} : std::string{'\0', c};
  return out;
}

std::string withLineEnds(const std::string& file, const std::string& end) {
  std::string out;
  for (const char c : file) out += c == '\n' ? end : std::string(1, c);
  return out;
}

void recode(std::string* file, Dice* dice) {
  switch (dice->below(7)) {
    case 0:
      *file = "\xef\xbb\xbf" + *file;
      break;
    case 1:
      *file = "\xff\xfe" + wide(*file, true);
      break;
    case 2:
      *file = "\xfe\xff" + wide(*file, false);
      break;
    case 3:
      *file = wide(*file, dice->oneIn(2));
      break;
    case 4:
      *file = withLineEnds(*file, dice->oneIn(2) ? "\r" : "\r\n");
      break;
    case 5:
      file->insert(dice->below(file->size() + 1),
                   dice->oneIn(2) ? "\xe4\xf6\xfc" : "\xc3\xa4\xf0\x9f\x98\x80");
      break;
    default:
      for (char& c : *file) c = c == '.' ? ',' : c;
  }
}

void damageOnce(std::string* file, const std::vector<std::string>& others, Dice* dice) {
  switch (dice->below(12)) {
    case 0:
      return flipBits(file, dice);
    case 1:
      return overwriteByte(file, dice);
    case 2:
      return overwriteNumber(file, dice);
    case 3:
      return cutOff(file, dice);
    case 4:
      return removePiece(file, dice);
    case 5:
      return repeatPiece(file, dice);
    case 6:
      return movePiece(file, dice);
    case 7:
    case 8:
      return replaceNumber(file, dice);
    case 9:
      return insertWord(file, dice);
    case 10:
      return splice(file, others, dice);
    default:
      return recode(file, dice);
  }
}

}  // namespace

uint64_t Dice::next() {
  uint64_t z = state_ += 0x9e3779b97f4a7c15;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
  z = (z ^ z >> 27) * 0x94d049bb133111eb;
  return z ^ z >> 31;
}

std::string damaged(std::string file, const std::vector<std::string>& others, Dice* dice) {
  for (size_t n = 1 + (dice->oneIn(2) ? 0 : dice->below(5)); n > 0; --n) {
    damageOnce(&file, others, dice);
    if (file.size() > kLargest) file.resize(kLargest);
  }
  return file;
}

}  // namespace monocular_eye_hand::fuzz
