#pragma once
#include <string>

namespace monocular_eye_hand {

/// Words and lines of a text file held in memory, with the line number for messages. Numbers are read in the
/// C locale whatever the program's locale is.
class TextScanner {
 public:
  TextScanner(const std::string& text, size_t begin, std::string file)
      : text_(text), at_(begin), file_(std::move(file)) {}

  /// Next word, or "" at the end of the text.
  std::string word();
  /// The rest of this line without its line end (line feed, carriage return or both); moves to the next line.
  std::string line();
  bool atEnd();
  /// The word or line that follows stands at this byte; line numbers go on as if nothing was skipped.
  void moveTo(size_t position) { at_ = position; }
  size_t position() const { return at_; }
  size_t remaining() const { return text_.size() - at_; }
  int lineNumber() const { return line_; }
  /// Next word as a finite number; `what` names it in the message. Throws BadInput.
  double number(const char* what);
  /// The same, but infinite or not a number (nan) as well.
  double anyNumber(const char* what);
  /// Next word as an integer (3 or 3.0). Throws BadInput.
  long long integer(const char* what);
  /// Throws BadInput "<file>, line <n>: <problem>".
  [[noreturn]] void fail(const std::string& problem) const;

 private:
  void skipBlank();
  std::string neededWord(const char* what);
  const std::string& text_;
  size_t at_;
  int line_ = 1;
  std::string file_;
};

}  // namespace monocular_eye_hand
