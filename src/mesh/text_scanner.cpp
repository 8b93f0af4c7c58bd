#include "mesh/text_scanner.h"

#include <locale.h>

#include <cerrno>
#include <cmath>
#include <cstdlib>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f'; }

double parseInCLocale(const char* text, char** end) {
  static const locale_t c_locale = newlocale(LC_ALL_MASK, "C", nullptr);
  return strtod_l(text, end, c_locale);
}

/// Words from strangers go into messages: keep them short and printable.
std::string quoted(const std::string& word) {
  std::string out = "\"";
  for (const char c : word.substr(0, 24)) out += (c >= 32 && c < 127) ? c : '?';
  return out + (word.size() > 24 ? "...\"" : "\"");
}

}  // namespace

void TextScanner::skipBlank() {
  while (at_ < text_.size() && blank(text_[at_])) {
    // A carriage return ends a line, too, unless a line feed follows.
    const bool carriage_return = text_[at_] == '\r' && (at_ + 1 == text_.size() || text_[at_ + 1] != '\n');
    if (text_[at_] == '\n' || carriage_return) ++line_;
    ++at_;
  }
}

std::string TextScanner::word() {
  skipBlank();
  const size_t begin = at_;
  while (at_ < text_.size() && !blank(text_[at_])) ++at_;
  return text_.substr(begin, at_ - begin);
}

std::string TextScanner::line() {
  const size_t begin = at_;
  while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
  const size_t end = at_;
  if (at_ < text_.size()) {
    if (text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n') ++at_;
    ++at_;
    ++line_;
  }
  return text_.substr(begin, end - begin);
}

bool TextScanner::atEnd() {
  skipBlank();
  return at_ >= text_.size();
}

std::string TextScanner::neededWord(const char* what) {
  const std::string w = word();
  if (w.empty())
    fail(std::string("the file ends where ") + what + " should stand; it was cut off: export it again");
  return w;
}

double TextScanner::number(const char* what) {
  const double value = anyNumber(what);
  if (!std::isfinite(value)) fail(std::string(what) + " is not a finite number: repair the mesh");
  return value;
}

double TextScanner::anyNumber(const char* what) {
  const std::string w = neededWord(what);
  char* end = nullptr;
  const double value = parseInCLocale(w.c_str(), &end);
  if (end == w.c_str() + w.size()) return value;
  const char* hint = *end == ',' ? "; numbers need a decimal point, not a comma: export it again" : "";
  fail(quoted(w) + " stands where " + what + " (a number) should stand" + hint);
}

long long TextScanner::integer(const char* what) {
  const std::string w = neededWord(what);
  char* end = nullptr;
  errno = 0;
  const long long value = std::strtoll(w.c_str(), &end, 10);
  if (end == w.c_str() + w.size() && errno == 0) return value;

  // Some scripts write every number as a real one: 3.0.
  const double real = parseInCLocale(w.c_str(), &end);
  if (end == w.c_str() + w.size() && std::abs(real) < 1e15 && real == std::floor(real))
    return (long long)(real);
  fail(quoted(w) + " stands where " + what + " (an integer) should stand");
}

void TextScanner::fail(const std::string& problem) const {
  throw BadInput(file_ + ", line " + std::to_string(line_) + ": " + problem);
}

}  // namespace monocular_eye_hand
