#pragma once
#include <string>
#include <utility>
#include <vector>

namespace monocular_eye_hand {

/// Text for HTML: & < > " ' replaced; bytes that are not UTF-8 and control characters become U+FFFD.
std::string escapeHtml(const std::string& text);

/// Number as a reader wants it: four significant digits, no trailing zeros.
std::string shortNumber(double value);

/// Builds one self-contained page. Everything passed in is text and gets escaped here.
class HtmlPage {
 public:
  explicit HtmlPage(const std::string& title);
  void heading(const std::string& text, const std::string& anchor);
  void paragraph(const std::string& text);
  /// A picture beside the page with a caption; `wide`: over the whole width.
  void figure(const std::string& file, const std::string& caption, bool wide);
  /// A chart of charts.h, which is SVG and not escaped again, with a caption ("" = none).
  void chart(const std::string& svg, const std::string& caption);
  /// What colours mean: CSS colour and text.
  void legend(const std::vector<std::pair<std::string, std::string>>& entries);
  /// `broad`: for pictures that are two side by side.
  void beginGrid(bool broad = false);
  void endGrid();
  using Row = std::vector<std::string>;
  void table(const Row& head, const std::vector<Row>& rows);
  /// A framed box: picture, title, badge ("accepted"...), text, terms.
  struct Card {
    std::string picture, title, badge, badge_class, text;
    std::vector<std::pair<std::string, std::string>> terms;
  };
  void card(const Card& card);
  std::string text() const;

 private:
  std::string title_, links_, body_;
};

}  // namespace monocular_eye_hand
