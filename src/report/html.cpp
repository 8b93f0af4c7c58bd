#include "report/html.h"

#include <fmt/format.h>

#include <cstdint>

namespace monocular_eye_hand {
namespace {

const char* kReplacement = "\xEF\xBF\xBD";  // U+FFFD

const char* kStyle = R"(
:root { --ink: #1d2430; --soft: #667085; --line: #e3e7ee; --ground: #f6f7f9; --good: #15803d; --warn: #b45309;
        --bad: #b91c1c; }
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--ink);
       font: 15px/1.5 system-ui, -apple-system, "Segoe UI", "DejaVu Sans", sans-serif; }
header { background: #1d2430; color: #fff; padding: 26px 5vw 18px; }
header h1 { margin: 0 0 8px; font-size: 24px; font-weight: 600; }
nav a { color: #b9c6dc; text-decoration: none; margin-right: 18px; font-size: 14px; }
nav a:hover { color: #fff; }
main { max-width: 1320px; margin: 0 auto; padding: 8px 5vw 60px; }
h2 { margin: 38px 0 10px; font-size: 19px; }
p { max-width: 75em; }
.grid { display: grid; grid-template-columns: repeat(auto-fill, minmax(400px, 1fr)); gap: 18px; }
.broad { grid-template-columns: repeat(auto-fill, minmax(min(560px, 100%), 1fr)); }
figure, .card { margin: 0; background: #fff; border: 1px solid var(--line); border-radius: 8px; overflow: hidden; }
figure.wide { max-width: 1280px; margin-bottom: 18px; }
img { display: block; width: 100%; height: auto; }
svg { display: block; width: 100%; height: auto; font-variant-numeric: tabular-nums; }
.chart svg { max-height: 400px; }
.swatch { display: inline-block; width: 22px; height: 5px; margin: 0 7px 3px 14px; background: #000;
          border: 1px solid #1d2430; }
figcaption { padding: 8px 12px; color: var(--soft); font-size: 14px; }
.card .body { padding: 10px 14px 14px; }
.card h3 { margin: 0 0 4px; font-size: 16px; }
.badge { float: right; font-size: 12px; padding: 2px 9px; border-radius: 10px; color: #fff; }
.accepted { background: var(--good); } .ambiguous { background: var(--warn); } .rejected { background: var(--bad); }
table { border-collapse: collapse; background: #fff; border: 1px solid var(--line); }
th, td { padding: 5px 14px; text-align: left; border-bottom: 1px solid var(--line); font-variant-numeric: tabular-nums; }
td:not(:last-child) { white-space: nowrap; }
th { font-weight: 600; color: var(--soft); font-size: 13px; }
.terms { margin: 8px 0 0; display: grid; grid-template-columns: auto 1fr; gap: 1px 14px; font-size: 13px; }
.broad .terms { grid-template-columns: auto 1fr auto 1fr; }
.terms dt { color: var(--soft); } .terms dd { margin: 0; font-variant-numeric: tabular-nums; }
)";

// Length of the UTF-8 sequence at `k`; 0 when it is damaged.
size_t sequenceLength(const std::string& text, size_t k) {
  const auto byte = [&](size_t i) { return i < text.size() ? uint8_t(text[i]) : uint8_t(0); };
  const uint8_t first = byte(k), second = byte(k + 1);
  if (first < 0x80) return 1;
  const size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4) return 0;
  for (size_t i = 1; i < length; ++i)
    if ((byte(k + i) & 0xC0) != 0x80) return 0;
  const bool overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool outside = (first == 0xED && second >= 0xA0) || (first == 0xF4 && second >= 0x90);
  return overlong || outside ? 0 : length;
}

}  // namespace

std::string escapeHtml(const std::string& text) {
  std::string out;
  for (size_t k = 0; k < text.size();) {
    const size_t length = sequenceLength(text, k);
    const char c = text[k];
    if (length == 0 || (length == 1 && (uint8_t(c) < 0x20 || c == 0x7F) && c != '\n' && c != '\t')) {
      out += kReplacement;
      ++k;
      continue;
    }

    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else if (c == '\'') {
      out += "&#39;";
    } else {
      out.append(text, k, length);
    }
    k += length;
  }
  return out;
}

std::string shortNumber(double value) { return fmt::format("{:.4g}", value); }

HtmlPage::HtmlPage(const std::string& title) : title_(escapeHtml(title)) {}

void HtmlPage::heading(const std::string& text, const std::string& anchor) {
  const std::string id = escapeHtml(anchor), shown = escapeHtml(text);
  links_ += "<a href=\"#" + id + "\">" + shown + "</a>\n";
  body_ += "<h2 id=\"" + id + "\">" + shown + "</h2>\n";
}

void HtmlPage::paragraph(const std::string& text) { body_ += "<p>" + escapeHtml(text) + "</p>\n"; }

void HtmlPage::figure(const std::string& file, const std::string& caption, bool wide) {
  const std::string source = escapeHtml(file), shown = escapeHtml(caption);
  body_ += std::string("<figure") + (wide ? " class=\"wide\"" : "") + "><a href=\"" + source +
           "\"><img src=\"" + source + "\" alt=\"" + shown + "\"></a><figcaption>" + shown +
           "</figcaption></figure>\n";
}

void HtmlPage::chart(const std::string& svg, const std::string& caption) {
  body_ += "<figure class=\"chart\">" + svg;
  if (!caption.empty()) body_ += "<figcaption>" + escapeHtml(caption) + "</figcaption>";
  body_ += "</figure>\n";
}

void HtmlPage::legend(const std::vector<std::pair<std::string, std::string>>& entries) {
  body_ += "<p>";
  for (const auto& [colour, text] : entries)
    body_ += "<span class=\"swatch\" style=\"background:" + escapeHtml(colour) + "\"></span>" +
             escapeHtml(text) + " ";
  body_ += "</p>\n";
}

void HtmlPage::beginGrid(bool broad) {
  body_ += broad ? "<div class=\"grid broad\">\n" : "<div class=\"grid\">\n";
}
void HtmlPage::endGrid() { body_ += "</div>\n"; }

void HtmlPage::table(const Row& head, const std::vector<Row>& rows) {
  body_ += "<table><thead><tr>";
  for (const std::string& cell : head) body_ += "<th>" + escapeHtml(cell) + "</th>";
  body_ += "</tr></thead><tbody>\n";
  for (const Row& row : rows) {
    body_ += "<tr>";
    for (const std::string& cell : row) body_ += "<td>" + escapeHtml(cell) + "</td>";
    body_ += "</tr>\n";
  }
  body_ += "</tbody></table>\n";
}

void HtmlPage::card(const Card& card) {
  body_ += "<div class=\"card\">";
  if (!card.picture.empty()) {
    const std::string source = escapeHtml(card.picture);
    body_ +=
        "<a href=\"" + source + "\"><img src=\"" + source + "\" alt=\"" + escapeHtml(card.title) + "\"></a>";
  }
  body_ += "<div class=\"body\"><span class=\"badge " + escapeHtml(card.badge_class) + "\">" +
           escapeHtml(card.badge) + "</span><h3>" + escapeHtml(card.title) + "</h3>" + escapeHtml(card.text);
  if (!card.terms.empty()) {
    body_ += "<dl class=\"terms\">";
    for (const auto& [term, value] : card.terms)
      body_ += "<dt>" + escapeHtml(term) + "</dt><dd>" + escapeHtml(value) + "</dd>";
    body_ += "</dl>";
  }
  body_ += "</div></div>\n";
}

std::string HtmlPage::text() const {
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         title_ + "</title>\n<style>" + kStyle + "</style></head>\n<body><header><h1>" + title_ +
         "</h1><nav>\n" + links_ + "</nav></header>\n<main>\n" + body_ + "</main></body></html>\n";
}

}  // namespace monocular_eye_hand
