#include "monocular_eye_hand/evaluation/results.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <locale>
#include <sstream>

#include "evaluation/json_file.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

std::ofstream openForWriting(const std::string& path) {
  std::ofstream file(path);
  if (!file) throw BadInput(path + ": cannot be written");
  file.imbue(std::locale::classic());
  file.precision(std::numeric_limits<double>::max_digits10);
  return file;
}

void close(std::ofstream* file, const std::string& path) {
  file->close();
  if (!*file) throw BadInput(path + ": cannot be written (disk full?)");
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields(1);
  for (char c : line)
    if (c == ',')
      fields.emplace_back();
    else if (c != '\r')
      fields.back() += c;
  return fields;
}

// The rows of a CSV file, with its checks: every message names file and line.
class CsvReader {
 public:
  CsvReader(const std::string& path, size_t fields) : path_(path), field_count_(fields), file_(path) {
    file_.peek();
    if (!file_.is_open() || file_.bad()) throw BadInput(path + ": cannot be read");
    file_.clear();
  }

  /// Next row that is neither empty nor the header.
  bool next() {
    std::string line;
    while (std::getline(file_, line)) {
      ++line_;
      if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
      if (line_ == 1 && line.rfind("scene_id", 0) == 0) continue;
      fields_ = split(line);
      if (fields_.size() != field_count_)
        fail(fmt::format("has {} fields, {} comma-separated ones expected", fields_.size(), field_count_));
      return true;
    }
    return false;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw BadInput(fmt::format("{}:{}: {}", path_, line_, what));
  }

  std::vector<double> numbers(size_t field, const char* name, size_t count) const {
    std::istringstream in(fields_[field]);
    in.imbue(std::locale::classic());
    std::vector<double> values;
    for (double value; in >> value;) values.push_back(value);
    if (!in.eof() || values.size() != count)
      fail(fmt::format("{} = '{}': {}{}", name, fields_[field], count,
                       count == 1 ? " number expected" : " numbers expected"));
    for (double value : values)
      if (!std::isfinite(value)) fail(std::string(name) + " is not finite");
    return values;
  }

  int integer(size_t field, const char* name) const {
    const double value = numbers(field, name, 1)[0];
    if (value != std::floor(value) || std::abs(value) > std::numeric_limits<int>::max())
      fail(std::string(name) + " = '" + fields_[field] + "': an integer is expected");
    return int(value);
  }

 private:
  std::string path_;
  size_t field_count_;
  std::ifstream file_;
  int line_ = 0;
  std::vector<std::string> fields_;
};

}  // namespace

void writeBopResults(const std::string& path, const std::vector<BopResult>& results) {
  std::ofstream file = openForWriting(path);
  file << "scene_id,im_id,obj_id,score,R,t,time\n";
  for (const BopResult& row : results) {
    file << row.scene << ',' << row.image << ',' << row.object << ',' << row.score << ',';
    const Eigen::Matrix3d& r = row.camera_from_object.rotation;
    for (int i = 0; i < 9; ++i) file << (i ? " " : "") << r(i / 3, i % 3);
    file << ',';
    const Eigen::Vector3d t = row.camera_from_object.translation / kMetresPerMillimetre;
    file << t.x() << ' ' << t.y() << ' ' << t.z() << ',' << row.time << '\n';
  }
  close(&file, path);
}

std::vector<BopResult> readBopResults(const std::string& path) {
  std::vector<BopResult> results;
  ImageTimes times;
  CsvReader reader(path, 7);

  while (reader.next()) {
    BopResult row;
    row.scene = reader.integer(0, "scene_id");
    row.image = reader.integer(1, "im_id");
    row.object = reader.integer(2, "obj_id");
    row.score = reader.numbers(3, "score", 1)[0];

    const std::vector<double> r = reader.numbers(4, "R", 9), t = reader.numbers(5, "t", 3);
    row.camera_from_object.rotation =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(r.data());
    row.camera_from_object.translation = Eigen::Vector3d(t[0], t[1], t[2]) * kMetresPerMillimetre;
    const Eigen::Matrix3d& rotation = row.camera_from_object.rotation;
    if (!(rotation * rotation.transpose()).isIdentity(1e-3) ||
        rotation.col(0).cross(rotation.col(1)).dot(rotation.col(2)) < 0)
      reader.fail("R is not a rotation");

    row.time = reader.numbers(6, "time", 1)[0];
    const auto first = times.emplace(std::make_pair(row.scene, row.image), row.time).first;
    if (std::abs(first->second - row.time) > 1e-3)
      reader.fail(fmt::format(
          "time differs from the other rows of scene {}, image {} (it is the time of the whole image)",
          row.scene, row.image));
    results.push_back(row);
  }
  return results;
}

void writeImageTimes(const std::string& path, const ImageTimes& times) {
  std::ofstream file = openForWriting(path);
  file << "scene_id,im_id,time\n";
  for (const auto& entry : times)
    file << entry.first.first << ',' << entry.first.second << ',' << entry.second << '\n';
  close(&file, path);
}

ImageTimes readImageTimes(const std::string& path) {
  ImageTimes times;
  CsvReader reader(path, 3);
  while (reader.next())
    times[{reader.integer(0, "scene_id"), reader.integer(1, "im_id")}] = reader.numbers(2, "time", 1)[0];
  return times;
}

std::string imageTimesPath(const std::string& results_path) {
  const size_t dot = results_path.size() >= 4 && results_path.substr(results_path.size() - 4) == ".csv"
                         ? results_path.size() - 4
                         : results_path.size();
  return results_path.substr(0, dot) + ".times.csv";
}

}  // namespace monocular_eye_hand
