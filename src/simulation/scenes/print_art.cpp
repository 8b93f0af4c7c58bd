#include "simulation/scenes/print_art.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

namespace monocular_eye_hand {
namespace {

using Points = std::vector<cv::Point>;

/// Two layers drawn alike: the ink's albedo and where there is ink; both 0..255.
class Sheet {
 public:
  Sheet(const cv::Size& size, double ground, Generator* random)
      : tone_(size, uchar(0)), cover_(size, uchar(0)), ground_(ground), random_(random) {
    ink_ = drawInk();
    tone_.setTo(grey(ink_));
  }
  int width() const { return tone_.cols; }
  int height() const { return tone_.rows; }
  int minSide() const { return std::min(width(), height()); }
  double ground() const { return ground_; }
  double ink() const { return ink_; }
  Generator& random() { return *random_; }
  double share(double low, double high) { return random_->uniform(low, high); }
  cv::Point anywhere() {
    return {random_->integer(0, std::max(0, width() - 1)), random_->integer(0, std::max(0, height() - 1))};
  }

  /// Dark on bright and bright on dark, sometimes of little contrast.
  double drawInk() {
    const bool faint = random_->integer(0, 4) == 0;
    const double distance = faint ? share(0.06, 0.15) : share(0.25, 0.7);
    const double darker = ground_ - distance, brighter = ground_ + distance;
    const bool dark = ground_ > 0.4 || brighter > 0.95;
    return std::clamp(dark ? darker : brighter, 0.03, 0.92);
  }

  void fill(double tone, double cover = 1) {
    tone_.setTo(grey(tone));
    cover_.setTo(grey(cover));
  }
  void rectangle(const cv::Rect& box, double tone, int thickness = -1, double cover = 1) {
    cv::rectangle(tone_, box, grey(tone), thickness);
    cv::rectangle(cover_, box, grey(cover), thickness);
  }
  void polygon(const Points& points, double tone, double cover = 1) {
    cv::fillPoly(tone_, std::vector<Points>{points}, grey(tone), cv::LINE_AA);
    cv::fillPoly(cover_, std::vector<Points>{points}, grey(cover), cv::LINE_AA);
  }
  void curve(const Points& points, double tone, int thickness, double cover = 1) {
    // The tone reaches farther than the cover: no rim of the old tone shines through.
    cv::polylines(tone_, std::vector<Points>{points}, false, grey(tone), thickness + 2);
    cv::polylines(cover_, std::vector<Points>{points}, false, grey(cover), thickness, cv::LINE_AA);
  }
  void circle(const cv::Point& centre, int radius, double tone, int thickness = -1, double cover = 1) {
    cv::circle(tone_, centre, radius, grey(tone), thickness, cv::LINE_AA);
    cv::circle(cover_, centre, radius, grey(cover), thickness, cv::LINE_AA);
  }
  /// `strength`: below 1 where a stroke is thinner than an element.
  void text(const std::string& words, const cv::Point& at, int font, double scale, double tone, int thickness,
            double strength) {
    cv::putText(tone_, words, at, font, scale, grey(tone), thickness + 1, cv::LINE_AA);
    cv::putText(cover_, words, at, font, scale, grey(strength), thickness, cv::LINE_AA);
  }
  void soften(double sigma) { cv::GaussianBlur(cover_, cover_, cv::Size(), sigma); }
  cv::Mat1b& tone() { return tone_; }
  cv::Mat1b& cover() { return cover_; }

  cv::Mat_<cv::Vec2f> picture() const {
    cv::Mat_<cv::Vec2f> out(tone_.size());
    for (int y = 0; y < out.rows; ++y)
      for (int x = 0; x < out.cols; ++x) {
        const float cover = float(cover_(y, x)) / 255;
        out(y, x) = {cover * float(tone_(y, x)) / 255, cover};
      }
    cv::GaussianBlur(out, out, cv::Size(3, 3), 0.5, 0.5, cv::BORDER_REPLICATE);
    return out;
  }

 private:
  static cv::Scalar grey(double share) { return cv::Scalar(255 * std::clamp(share, 0.0, 1.0)); }

  cv::Mat1b tone_, cover_;
  double ground_, ink_ = 0;
  Generator* random_;
};

std::string word(Generator* random, int min_letters, int max_letters) {
  static const std::string kVowels = "aeiou", kOthers = "bcdfghklmnprstvwz";
  const int style = random->integer(0, 3), length = random->integer(min_letters, max_letters);
  std::string out;
  for (int k = 0; k < length; ++k) {
    const std::string& from = k % 2 ? kVowels : kOthers;
    char c = from[size_t(random->integer(0, int(from.size()) - 1))];
    if (style == 0) c = char('0' + random->integer(0, 9));
    if (style == 1 || (style == 2 && k == 0)) c = char(std::toupper(c));
    out += c;
  }
  return out;
}

int printFont(Generator* random) {
  static const int kFonts[] = {cv::FONT_HERSHEY_SIMPLEX, cv::FONT_HERSHEY_DUPLEX, cv::FONT_HERSHEY_COMPLEX,
                               cv::FONT_HERSHEY_TRIPLEX, cv::FONT_HERSHEY_PLAIN};
  return kFonts[random->integer(0, 4)];
}

// As large as the box allows; nothing when that is below what can be drawn.
void wordsIn(Sheet* sheet, const cv::Rect& box, const std::string& words, int font, double tone,
             int weight = 1) {
  int baseline = 0;
  const cv::Size size = cv::getTextSize(words, font, 1, weight, &baseline);
  const double scale =
      std::min(double(box.width) / size.width, double(box.height) / (size.height + baseline));
  if (scale < 0.1) return;
  const int thickness = std::max(1, int(std::lround(weight * std::max(0.5, scale))));
  const double strength = std::clamp(1.8 * weight * scale, 0.35, 1.0);
  sheet->text(words, {box.x, box.y + int(scale * size.height)}, font, scale, tone, thickness, strength);
}

void linesOfText(Sheet* sheet, const cv::Rect& box, int lines, double tone) {
  const int step = std::max(3, box.height / std::max(1, lines)), drawn = printFont(&sheet->random());
  const int font = step < 16 ? cv::FONT_HERSHEY_SIMPLEX : drawn;  // of small letters others make blots
  for (int y = box.y; y + step <= box.y + box.height + 1; y += step) {
    std::string words = word(&sheet->random(), 2, 8);
    const int count = std::max(1, int(box.width / (step * 0.7) / 6));
    for (int k = 1; k < count; ++k) words += " " + word(&sheet->random(), 2, 8);
    const int length = int(box.width * sheet->share(0.6, 1));
    wordsIn(sheet, {box.x, y, length, std::max(2, int(0.75 * step))}, words, font, tone);
  }
}

void bars(Sheet* sheet, const cv::Rect& box, double tone, double gap_tone) {
  sheet->rectangle(box, gap_tone);
  const int unit = std::max(1, box.width / 60);
  for (int x = box.x + 2 * unit; x + 4 * unit < box.x + box.width;) {
    const int bar = unit * sheet->random().integer(1, 3);
    sheet->rectangle({x, box.y + unit, bar, std::max(1, box.height - 2 * unit)}, tone);
    x += bar + unit * sheet->random().integer(1, 3);
  }
}

void tag(Sheet* sheet, const cv::Rect& box) {
  const int cells = sheet->random().integer(5, 9), cell = std::max(1, box.width / (cells + 2));
  sheet->rectangle({box.x, box.y, cell * (cells + 2), cell * (cells + 2)}, 0.85);
  sheet->rectangle({box.x + cell / 2, box.y + cell / 2, cell * (cells + 1), cell * (cells + 1)}, 0.05);
  for (int y = 1; y < cells; ++y)
    for (int x = 1; x < cells; ++x)
      if (sheet->random().integer(0, 1) == 1)
        sheet->rectangle({box.x + cell / 2 + x * cell, box.y + cell / 2 + y * cell, cell, cell}, 0.85);
}

Points blob(Sheet* sheet, const cv::Point& centre, double radius, int corners, double roughness) {
  Points points;
  const double first = sheet->share(0, 2 * M_PI);
  for (int k = 0; k < corners; ++k) {
    const double angle = first + 2 * M_PI * k / corners, r = radius * sheet->share(1 - roughness, 1);
    points.emplace_back(centre.x + int(r * std::cos(angle)), centre.y + int(r * std::sin(angle)));
  }
  return points;
}

Points stroke(Sheet* sheet, const cv::Point& from, double length, double bend) {
  Points points{from};
  double angle = sheet->share(0, 2 * M_PI), turn = 0;
  cv::Point2d at = from;
  for (int k = 0; k < 24; ++k) {
    turn = 0.8 * turn + bend * sheet->share(-1, 1);
    angle += turn;
    at += cv::Point2d(std::cos(angle), std::sin(angle)) * (length / 24);
    points.emplace_back(int(at.x), int(at.y));
  }
  return points;
}

void shapeIn(Sheet* sheet, const cv::Rect& box, double tone, double outline) {
  const cv::Point centre(box.x + int(box.width * sheet->share(0.2, 0.8)),
                         box.y + int(box.height * sheet->share(0.2, 0.8)));
  const double radius = std::min(box.width, box.height) * sheet->share(0.12, 0.5);

  switch (sheet->random().integer(0, 4)) {
    case 0: {
      const Points points =
          blob(sheet, centre, radius, sheet->random().integer(3, 6), sheet->share(0.0, 0.3));
      sheet->polygon(points, tone);
      Points closed = points;
      closed.push_back(points.front());
      if (outline >= 0) sheet->curve(closed, outline, std::max(1, int(radius / 25)));
      break;
    }
    case 1:
      sheet->circle(centre, std::max(1, int(radius)), tone);
      if (outline >= 0)
        sheet->circle(centre, std::max(1, int(radius)), outline, std::max(1, int(radius / 20)));
      break;
    case 2: {
      Points smooth;
      cv::ellipse2Poly(centre, cv::Size(int(radius) + 1, int(radius * sheet->share(0.3, 0.9)) + 1),
                       sheet->random().integer(0, 179), 0, 360, 8, smooth);
      sheet->polygon(smooth, tone);
      break;
    }
    case 3:
      sheet->polygon(blob(sheet, centre, radius, 14, 0.5), tone);
      break;
    default:
      sheet->curve(stroke(sheet, centre, 3 * radius, 0.5), tone, std::max(1, int(radius / 6)));
      break;
  }
}

cv::Rect inner(const cv::Size& size, double margin) {
  const int x = int(margin * std::min(size.width, size.height));
  return {x, x, std::max(1, size.width - 2 * x), std::max(1, size.height - 2 * x)};
}

void drawHandwriting(Sheet* sheet) {
  static const int kScripts[] = {cv::FONT_HERSHEY_SCRIPT_SIMPLEX, cv::FONT_HERSHEY_SCRIPT_COMPLEX,
                                 cv::FONT_HERSHEY_SIMPLEX | cv::FONT_ITALIC};
  const int lines = sheet->random().integer(1, 2), step = sheet->height() / lines;
  for (int k = 0; k < lines; ++k) {
    const int font = kScripts[sheet->random().integer(0, 2)];
    const cv::Rect box(sheet->width() / 20, k * step + step / 10, sheet->width() * 9 / 10, step * 8 / 10);
    wordsIn(sheet, box, word(&sheet->random(), 2, 6), font, sheet->ink(), sheet->random().integer(1, 3));
  }
  if (sheet->random().integer(0, 1) == 0) return;
  const int pen = std::max(1, sheet->minSide() / 30);
  sheet->curve(stroke(sheet, {sheet->width() / 10, sheet->height() * 4 / 5}, sheet->width() * 0.8, 0.3),
               sheet->ink(), pen);
}

void drawLabel(Sheet* sheet) {
  const bool dark = sheet->random().integer(0, 5) == 0;
  const double paper = dark ? sheet->share(0.05, 0.25) : sheet->share(0.6, 0.9);
  const double ink = dark ? sheet->share(0.6, 0.9) : sheet->share(0.04, 0.2);
  sheet->fill(paper);
  const cv::Rect box = inner({sheet->width(), sheet->height()}, 0.08);
  if (sheet->random().integer(0, 1) == 1) sheet->rectangle(box, ink, std::max(1, sheet->minSide() / 50));
  const cv::Rect text(box.x + box.width / 20, box.y + box.height / 12, box.width * 9 / 10,
                      box.height * 8 / 10);
  const int split = text.height * sheet->random().integer(3, 6) / 10;
  const int font = printFont(&sheet->random());
  wordsIn(sheet, {text.x, text.y, text.width * 7 / 10, split * 8 / 10}, word(&sheet->random(), 4, 9), font,
          ink, 2);
  const cv::Rect rest(text.x, text.y + split, text.width, text.height - split);
  if (sheet->random().integer(0, 1) == 1 && rest.width > 40)
    bars(sheet, {rest.x, rest.y, rest.width * 6 / 10, rest.height}, ink, paper);
  else
    linesOfText(sheet, rest, sheet->random().integer(2, 4), ink);
}

void drawLogo(Sheet* sheet) {
  const cv::Point centre(sheet->width() / 2, sheet->height() / 2);
  const int radius = std::max(2, int(0.46 * sheet->minSide()));
  switch (sheet->random().integer(0, 2)) {
    case 0:
      sheet->circle(centre, radius, sheet->ink(), std::max(1, radius / 6));
      break;
    case 1:
      sheet->polygon(blob(sheet, centre, radius, sheet->random().integer(3, 6), 0), sheet->ink());
      break;
    default:
      sheet->polygon(blob(sheet, centre, radius, 10, 0.6), sheet->ink());
      break;
  }
  const double letters = sheet->random().integer(0, 1) ? sheet->ground() : sheet->drawInk();
  const int half = radius / 2;
  wordsIn(sheet, {centre.x - half, centre.y - half, 2 * half, 2 * half}, word(&sheet->random(), 1, 3),
          printFont(&sheet->random()), letters, 3);
}

void drawPatchwork(Sheet* sheet) {
  const int columns = sheet->random().integer(1, 3), rows = sheet->random().integer(1, 3);
  const double outline = sheet->random().integer(0, 2) ? sheet->share(0.03, 0.3) : -1;
  sheet->fill(sheet->share(0.1, 0.85));
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const cv::Rect cell(sheet->width() * column / columns, sheet->height() * row / rows,
                          sheet->width() / columns + 1, sheet->height() / rows + 1);
      sheet->rectangle(cell, sheet->share(0.15, 0.85));
      const int shapes = sheet->random().integer(2, 7);
      for (int k = 0; k < shapes; ++k) shapeIn(sheet, cell, sheet->share(0.08, 0.88), outline);
    }
  if (sheet->random().integer(0, 1) == 0) return;
  const int strokes = sheet->random().integer(2, 8);
  for (int k = 0; k < strokes; ++k)
    sheet->curve(stroke(sheet, sheet->anywhere(), sheet->minSide() * sheet->share(0.3, 1), 0.4),
                 sheet->share(0.05, 0.5), std::max(1, sheet->minSide() / 80));
}

// Smooth blotches between two greys, as a photograph seen from afar.
void photograph(Sheet* sheet, const cv::Rect& wanted) {
  const cv::Rect box = wanted & cv::Rect(0, 0, sheet->width(), sheet->height());
  if (box.width < 4 || box.height < 4) return;
  cv::Mat1f coarse(6, 8);
  for (float& value : coarse) value = float(sheet->share(0.05, 0.85));
  cv::Mat1f fine(24, 32), large, detail;
  for (float& value : fine) value = float(sheet->share(-0.2, 0.2));
  cv::resize(coarse, large, box.size(), 0, 0, cv::INTER_CUBIC);
  cv::resize(fine, detail, box.size(), 0, 0, cv::INTER_CUBIC);
  sheet->rectangle(box, 0.5);
  cv::Mat1f(255 * (large + detail)).convertTo(sheet->tone()(box), CV_8U);
  const int shapes = sheet->random().integer(1, 4);
  for (int k = 0; k < shapes; ++k) shapeIn(sheet, box, sheet->share(0.05, 0.85), -1);
}

void drawBoxFront(Sheet* sheet) {
  const int w = sheet->width(), h = sheet->height();
  const double first = sheet->share(0.08, 0.8), second = sheet->share(0.1, 0.85);
  sheet->fill(first);
  const int split = int(w * sheet->share(0.4, 0.75));
  sheet->rectangle({split, 0, w - split, h}, second);
  photograph(sheet, {int(w * sheet->share(0.02, 0.2)), int(h * sheet->share(0.35, 0.5)), split * 7 / 10,
                     int(h * sheet->share(0.3, 0.5))});
  const auto against = [](double ground) { return ground > 0.4 ? 0.06 : 0.85; };
  wordsIn(sheet, {w / 20, h / 20, split * 8 / 10, h / 4}, word(&sheet->random(), 5, 10),
          printFont(&sheet->random()), against(first), 3);
  linesOfText(sheet, {split + (w - split) / 10, h / 10, (w - split) * 8 / 10, h / 3}, 3, against(second));
  shapeIn(sheet, {split, h / 2, w - split, h / 2}, sheet->share(0.05, 0.9), against(second));
  if (sheet->random().integer(0, 1) == 1)
    bars(sheet, {split + (w - split) / 6, h * 3 / 4, (w - split) * 2 / 3, h / 6}, 0.05, 0.85);
}

void drawScratches(Sheet* sheet) {
  const bool bright = sheet->random().integer(0, 2) > 0;
  const double tone = bright ? std::min(0.95, sheet->ground() + 0.35) : sheet->ground() * 0.4;
  const int bundles = sheet->random().integer(1, 4);
  for (int b = 0; b < bundles; ++b) {
    const double main = sheet->share(0, M_PI);
    const int count = sheet->random().integer(2, 12);
    for (int k = 0; k < count; ++k) {
      const double angle = main + sheet->share(-0.2, 0.2), length = sheet->minSide() * sheet->share(0.1, 0.7);
      const cv::Point from = sheet->anywhere();
      const cv::Point to(from.x + int(length * std::cos(angle)), from.y + int(length * std::sin(angle)));
      sheet->curve({from, to}, tone, 1, sheet->share(0.2, 0.8));
    }
  }
}

void drawStains(Sheet* sheet) {
  const int count = sheet->random().integer(1, 5);
  for (int k = 0; k < count; ++k)
    sheet->polygon(blob(sheet, sheet->anywhere(), sheet->minSide() * sheet->share(0.1, 0.5), 12, 0.5),
                   sheet->ink(), sheet->share(0.15, 0.5));
  sheet->soften(std::max(0.6, sheet->minSide() * sheet->share(0.005, 0.06)));
}

void drawGrid(Sheet* sheet) {
  const int step = std::max(6, int(sheet->minSide() * sheet->share(0.04, 0.12)));
  const int thickness = std::max(1, step / 25);
  for (int x = step / 2; x < sheet->width(); x += step)
    sheet->rectangle({x, 0, thickness, sheet->height()}, sheet->ink());
  for (int y = step / 2; y < sheet->height(); y += step)
    sheet->rectangle({0, y, sheet->width(), thickness}, sheet->ink());
}

void drawPage(Sheet* sheet) {
  sheet->fill(sheet->share(0.65, 0.9));
  cv::Rect left = inner({sheet->width(), sheet->height()}, 0.1);
  const double ink = sheet->share(0.04, 0.2);

  while (left.height > sheet->height() / 10) {
    const int part = std::max(8, int(left.height * sheet->share(0.2, 0.6)));
    const cv::Rect block(left.x, left.y, left.width, std::min(part, left.height));
    switch (sheet->random().integer(0, 4)) {
      case 0:
        sheet->rectangle(block, ink, 1);
        shapeIn(sheet, block, sheet->share(0.1, 0.6), ink);
        break;
      case 1:
        photograph(sheet, block);
        break;
      default:
        linesOfText(sheet, block, std::max(1, block.height / std::max(5, sheet->height() / 30)), ink);
        break;
    }

    const int used = part + sheet->height() / 40 + 1;
    left.y += used;
    left.height -= used;
  }
}

void drawRuler(Sheet* sheet) {
  const int step = std::max(2, sheet->width() / 150);
  for (int k = 0; k * step < sheet->width(); ++k) {
    const int length = sheet->height() * (k % 10 == 0 ? 6 : k % 5 == 0 ? 4 : 3) / 10;
    sheet->rectangle({k * step, 0, 1, length}, sheet->ink());
    if (k % 10 == 0)
      wordsIn(sheet, {k * step + 1, sheet->height() * 6 / 10, 8 * step, sheet->height() * 3 / 10},
              std::to_string(k / 10), cv::FONT_HERSHEY_SIMPLEX, sheet->ink());
  }
}

}  // namespace

cv::Mat_<cv::Vec2f> drawArt(Art art, const cv::Size& texels, double ground, Generator* random) {
  const cv::Size size(std::clamp(texels.width, 4, 1600), std::clamp(texels.height, 4, 1600));
  Sheet sheet(size, ground, random);
  const cv::Rect whole = inner(size, 0.05);

  switch (art) {
    case Art::kText:
      linesOfText(&sheet, whole, random->integer(1, 4), sheet.ink());
      break;
    case Art::kHandwriting:
      drawHandwriting(&sheet);
      break;
    case Art::kLabel:
      drawLabel(&sheet);
      break;
    case Art::kBarcode:
      bars(&sheet, whole, 0.05, 0.85);
      break;
    case Art::kTag:
      tag(&sheet, {0, 0, sheet.minSide(), sheet.minSide()});
      break;
    case Art::kLogo:
      drawLogo(&sheet);
      break;
    case Art::kPatchwork:
      drawPatchwork(&sheet);
      break;
    case Art::kBoxFront:
      drawBoxFront(&sheet);
      break;
    case Art::kScratches:
      drawScratches(&sheet);
      break;
    case Art::kStains:
      drawStains(&sheet);
      break;
    case Art::kGrid:
      drawGrid(&sheet);
      break;
    case Art::kPage:
      drawPage(&sheet);
      break;
    case Art::kRuler:
      drawRuler(&sheet);
      break;
  }

  return sheet.picture();
}

}  // namespace monocular_eye_hand
