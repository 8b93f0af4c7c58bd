#pragma once
#include <string>
#include <vector>

namespace monocular_eye_hand {

// Charts as inline SVG. Texts are escaped here. Values are shares, 0..1.

/// One bar with a label below and a note above it, and its interval as a whisker.
struct ChartBar {
  std::string label, note;
  double value = 0, low = 0, high = 0;
  bool empty = false;  ///< nothing was counted: the note alone
};
std::string barChart(const std::string& title, const std::vector<ChartBar>& bars);

/// A point of a chart of shares over shares, with an interval (low = high: none).
struct ChartPoint {
  double x = 0, y = 0;
  double low = 0, high = 0;
  std::string note;  ///< shown when the pointer rests on it
};
/// Points in a square of 0..1, the diagonal drawn behind them.
std::string diagonalChart(const std::string& title, const std::string& x_name, const std::string& y_name,
                          const std::vector<ChartPoint>& points);
/// A line through the points; `marked` ones as dots with their notes beside them.
std::string curveChart(const std::string& title, const std::string& x_name, const std::string& y_name,
                       const std::vector<ChartPoint>& points, const std::vector<ChartPoint>& marked);

}  // namespace monocular_eye_hand
