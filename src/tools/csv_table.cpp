#include "tools/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

std::vector<std::string> fieldsOf(std::string line) {
  if (!line.empty() && line.back() == '\r') line.pop_back();
  std::vector<std::string> fields;
  size_t begin = 0;
  for (;;) {
    const size_t end = line.find(',', begin);
    fields.push_back(line.substr(begin, end - begin));
    if (end == std::string::npos) return fields;
    begin = end + 1;
  }
}

}  // namespace

CsvTable::CsvTable(const std::string& path) : path_(path) {
  std::ifstream file(path);
  std::string line;
  if (!file || !std::getline(file, line)) throw BadInput(path + ": cannot be read, or is empty");
  columns_ = fieldsOf(line);

  while (std::getline(file, line)) {
    if (line.empty()) continue;
    rows_.push_back(fieldsOf(line));
    if (rows_.back().size() != columns_.size())
      throw BadInput(fmt::format("{}, line {}: {} fields, the first line names {}", path, rows_.size() + 1,
                                 rows_.back().size(), columns_.size()));
  }
}

int CsvTable::find(const std::string& column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  return found == columns_.end() ? -1 : int(found - columns_.begin());
}

int CsvTable::column(const std::string& column) const {
  const int found = find(column);
  if (found < 0) throw BadInput(path_ + ": there is no column '" + column + "'");
  return found;
}

double CsvTable::number(size_t row, int column, double absent) const {
  const std::string& field = text(row, column);
  if (field.empty()) return absent;
  char* end = nullptr;
  const double value = std::strtod(field.c_str(), &end);
  if (end != field.c_str() + field.size())
    throw BadInput(
        fmt::format("{}, line {}, {}: '{}' is no number", path_, row + 2, columns_[size_t(column)], field));
  return value;
}

}  // namespace monocular_eye_hand
