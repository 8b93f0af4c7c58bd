#pragma once
#include <string>
#include <vector>

namespace monocular_eye_hand {

/// The bytes of a file; `kind` names it in messages ("a mesh file"). Throws BadInput when it is missing, a
/// folder, empty, larger than `max_bytes` or not readable.
std::string readFileBytes(const std::string& path, const std::string& kind, size_t max_bytes);

/// What the bytes really are, and what to do, when they are of a well-known kind that no reader of this
/// package takes: "a Git LFS pointer, not the file itself: run `git lfs pull` ...". Empty when they are not.
std::string foreignContent(const std::string& bytes);

/// True when the bytes hold what no text holds: a zero byte or another control character.
bool looksBinary(const std::string& bytes);

/// Text with what was changed to read it.
struct PlainText {
  std::string text;                   ///< UTF-8 or plain ASCII, without byte order mark
  std::vector<std::string> warnings;  ///< what was left out or converted
};

/// Converts UTF-16 (with or without byte order mark) to UTF-8 and leaves out the byte order mark of UTF-8.
PlainText plainText(std::string bytes);

/// Every line end as one line feed: carriage returns, alone or before a line feed, are replaced.
std::string withLineFeeds(const std::string& text);

}  // namespace monocular_eye_hand
