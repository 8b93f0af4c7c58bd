#include "report/charts.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/html.h"

namespace monocular_eye_hand {
namespace {

const char* kInk = "#1d2430";
const char* kSoft = "#667085";
const char* kGrid = "#e3e7ee";
const char* kBar = "#7aa7e0";
const char* kAccent = "#1d4ed8";
constexpr double kTop = 44, kLeft = 46, kRight = 16;  // margins [units of the view box]

std::string number(double value) { return fmt::format("{:.1f}", value); }

enum class Anchor { kStart, kMiddle, kEnd };

// The elements of one picture.
class Drawing {
 public:
  Drawing(double width, double height) : width_(width), height_(height) {}

  void line(double x1, double y1, double x2, double y2, const char* colour, double width = 1,
            const char* dashes = nullptr) {
    body_ += "<line x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" + number(x2) + "\" y2=\"" +
             number(y2) + "\" stroke=\"" + colour + "\" stroke-width=\"" + number(width) + "\"" +
             (dashes ? std::string(" stroke-dasharray=\"") + dashes + "\"" : std::string()) + "/>";
  }
  void bar(double x, double y, double width, double height, const std::string& note) {
    body_ += "<rect x=\"" + number(x) + "\" y=\"" + number(y) + "\" width=\"" + number(width) +
             "\" height=\"" + number(height) + "\" fill=\"" + kBar + "\">" + tip(note) + "</rect>";
  }
  void dot(double x, double y, double radius, const std::string& note) {
    body_ += "<circle cx=\"" + number(x) + "\" cy=\"" + number(y) + "\" r=\"" + number(radius) +
             "\" fill=\"" + kAccent + "\">" + tip(note) + "</circle>";
  }
  void path(const std::vector<ChartPoint>& points) {
    body_ += "<polyline fill=\"none\" stroke=\"" + std::string(kAccent) + "\" stroke-width=\"2\" points=\"";
    for (const ChartPoint& p : points) body_ += number(p.x) + "," + number(p.y) + " ";
    body_ += "\"/>";
  }
  void text(double x, double y, const std::string& text, Anchor anchor, double size = 12,
            const char* colour = kSoft, double rotation = 0) {
    const char* side = anchor == Anchor::kStart ? "start" : anchor == Anchor::kMiddle ? "middle" : "end";
    body_ += "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + side +
             "\" font-size=\"" + number(size) + "\" fill=\"" + colour + "\"" +
             (rotation == 0
                  ? std::string()
                  : " transform=\"rotate(" + number(rotation) + " " + number(x) + " " + number(y) + ")\"") +
             ">" + escapeHtml(text) + "</text>";
  }

  std::string svg(const std::string& title) {
    text(12, 22, title, Anchor::kStart, 14, kInk);
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" viewBox=\"0 0 " + number(width_) + " " +
           number(height_) + "\">" + tip(title) + body_ + "</svg>\n";
  }

 private:
  static std::string tip(const std::string& note) {
    return note.empty() ? "" : "<title>" + escapeHtml(note) + "</title>";
  }
  double width_, height_;
  std::string body_;
};

// The square that charts of shares over shares are drawn in.
class ShareAxes {
 public:
  static constexpr double kSide = 300, kWidth = kLeft + kSide + 70, kHeight = kTop + kSide + 46;

  static double x(double share) { return kLeft + kSide * std::clamp(share, 0.0, 1.0); }
  static double y(double share) { return kTop + kSide * (1 - std::clamp(share, 0.0, 1.0)); }

  static void draw(const std::string& x_name, const std::string& y_name, Drawing* drawing) {
    for (int k = 0; k <= 5; ++k) {
      const double share = k / 5.0;
      drawing->line(x(share), y(0), x(share), y(1), kGrid);
      drawing->line(x(0), y(share), x(1), y(share), kGrid);
      drawing->text(x(share), y(0) + 16, number(share), Anchor::kMiddle);
      drawing->text(x(0) - 6, y(share) + 4, number(share), Anchor::kEnd);
    }
    drawing->text(x(0.5), y(0) + 36, x_name, Anchor::kMiddle);
    drawing->text(14, y(0.5), y_name, Anchor::kMiddle, 12, kSoft, -90);
  }
};

}  // namespace

std::string barChart(const std::string& title, const std::vector<ChartBar>& bars) {
  constexpr double kPlot = 150, kWidth = 430;
  const double slot = std::min(60.0, (kWidth - kLeft - kRight) / double(std::max<size_t>(bars.size(), 1)));
  const double half = 0.34 * slot;  // of a bar's width
  Drawing drawing(kWidth, kTop + kPlot + 34);
  const auto y = [&](double share) { return kTop + 14 + (kPlot - 14) * (1 - share); };

  for (const double share : {0.0, 0.5, 1.0}) {
    drawing.line(kLeft, y(share), kWidth - kRight, y(share), kGrid);
    drawing.text(kLeft - 6, y(share) + 4, fmt::format("{} %", int(100 * share)), Anchor::kEnd, 11);
  }

  for (size_t k = 0; k < bars.size(); ++k) {
    const ChartBar& bar = bars[k];
    const double middle = kLeft + slot * (double(k) + 0.5);
    drawing.text(middle, y(0) + 16, bar.label, Anchor::kMiddle, 10, kInk);
    drawing.text(middle, kTop + 6, bar.note, Anchor::kMiddle, 10);
    if (bar.empty) continue;
    drawing.bar(middle - half, y(bar.value), 2 * half, y(0) - y(bar.value), bar.label + ": " + bar.note);
    drawing.line(middle, y(bar.low), middle, y(bar.high), kInk, 1.4);
    for (const double end : {bar.low, bar.high})
      drawing.line(middle - 4, y(end), middle + 4, y(end), kInk, 1.4);
  }

  return drawing.svg(title);
}

std::string diagonalChart(const std::string& title, const std::string& x_name, const std::string& y_name,
                          const std::vector<ChartPoint>& points) {
  using Axes = ShareAxes;
  Drawing drawing(Axes::kWidth, Axes::kHeight);
  Axes::draw(x_name, y_name, &drawing);
  drawing.line(Axes::x(0), Axes::y(0), Axes::x(1), Axes::y(1), kSoft, 1, "4 4");
  std::vector<ChartPoint> placed;
  for (const ChartPoint& p : points) placed.push_back({Axes::x(p.x), Axes::y(p.y), 0, 0, ""});
  drawing.path(placed);
  for (const ChartPoint& p : points) {
    drawing.line(Axes::x(p.x), Axes::y(p.low), Axes::x(p.x), Axes::y(p.high), kAccent, 1);
    drawing.dot(Axes::x(p.x), Axes::y(p.y), 4, p.note);
  }
  return drawing.svg(title);
}

std::string curveChart(const std::string& title, const std::string& x_name, const std::string& y_name,
                       const std::vector<ChartPoint>& points, const std::vector<ChartPoint>& marked) {
  using Axes = ShareAxes;
  Drawing drawing(Axes::kWidth, Axes::kHeight);
  Axes::draw(x_name, y_name, &drawing);
  std::vector<ChartPoint> placed;
  for (const ChartPoint& p : points) placed.push_back({Axes::x(p.x), Axes::y(p.y), 0, 0, ""});
  drawing.path(placed);
  for (const ChartPoint& p : marked) {
    drawing.dot(Axes::x(p.x), Axes::y(p.y), 4, p.note);
    // Beside the dot, where the curve is not: to the left of the right half.
    const bool left = p.x > 0.5;
    drawing.text(Axes::x(p.x) + (left ? -8 : 8), Axes::y(p.y) + 18, p.note,
                 left ? Anchor::kEnd : Anchor::kStart, 11, kInk);
  }
  return drawing.svg(title);
}

}  // namespace monocular_eye_hand
