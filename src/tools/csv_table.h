#pragma once
#include <string>
#include <vector>

namespace monocular_eye_hand {

/// A CSV file with a line of column names, as the tools write it: no quotes, no commas within a field.
class CsvTable {
 public:
  /// Throws BadInput naming file and line when it cannot be read or a line has another number of fields.
  explicit CsvTable(const std::string& path);

  const std::string& path() const { return path_; }
  const std::vector<std::string>& columns() const { return columns_; }
  size_t rows() const { return rows_.size(); }
  /// Index of a column, -1 without it.
  int find(const std::string& column) const;
  /// The same; throws BadInput naming file and column without it.
  int column(const std::string& column) const;
  const std::string& text(size_t row, int column) const { return rows_[row][size_t(column)]; }
  /// Throws BadInput naming file, line and column when the field is no number; `absent` where it is empty.
  double number(size_t row, int column, double absent = 0) const;

 private:
  std::string path_;
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace monocular_eye_hand
