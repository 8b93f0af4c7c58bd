#pragma once
#include <array>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/options/tree.h"

namespace monocular_eye_hand {

// An options struct lists its fields once:
//
//   template <class Visitor> void visit(Visitor&& v) { v("field", field); v("nested", nested); }
//
// Fields are bool, int, double, std::string, another options struct, or a std::vector or std::array of those.
// A key that is absent keeps the struct's default.

namespace options_detail {

// Scalars: throw BadInput naming `key`, the value and the type that was expected.
void read(const OptionTree& tree, const std::string& key, bool& field);
void read(const OptionTree& tree, const std::string& key, int& field);
void read(const OptionTree& tree, const std::string& key, double& field);
void read(const OptionTree& tree, const std::string& key, std::string& field);
void requireList(const OptionTree& tree, const std::string& key);
void requireLength(const OptionTree& tree, const std::string& key, size_t length);
void requireMap(const OptionTree& tree, const std::string& key);
/// Throws BadInput with the first key of `tree` that is not in `known`, by its full name, and the nearest
/// known one.
void requireKnown(const OptionTree& tree, const std::string& key, const std::vector<std::string>& known);
std::string join(const std::string& parent, const std::string& key);
std::string index(const std::string& key, size_t i);

OptionTree write(bool field);
OptionTree write(int field);
OptionTree write(double field);
OptionTree write(const std::string& field);

struct AnyVisitor {
  template <class T>
  void operator()(const char*, T&) {}
};
template <class T, class = void>
struct HasVisit : std::false_type {};
template <class T>
struct HasVisit<T, std::void_t<decltype(std::declval<T&>().visit(std::declval<AnyVisitor&>()))>>
    : std::true_type {};
template <class T, class = void>
struct HasCheck : std::false_type {};
template <class T>
struct HasCheck<T, std::void_t<decltype(std::declval<const T&>().check())>> : std::true_type {};

// Declared first: fields nest in any order.
template <class T>
void read(const OptionTree& tree, const std::string& key, std::vector<T>& field);
template <class T, size_t N>
void read(const OptionTree& tree, const std::string& key, std::array<T, N>& field);
template <class T>
std::enable_if_t<HasVisit<T>::value> read(const OptionTree& tree, const std::string& key, T& field);
template <class T>
OptionTree write(const std::vector<T>& field);
template <class T, size_t N>
OptionTree write(const std::array<T, N>& field);
template <class T>
std::enable_if_t<HasVisit<T>::value, OptionTree> write(const T& field);

struct Reader {
  const OptionTree& tree;
  const std::string& parent;
  std::vector<std::string> known;

  template <class T>
  void operator()(const char* key, T& field) {
    known.push_back(key);
    if (const OptionTree* value = tree.find(key)) read(*value, join(parent, key), field);
  }
};

struct Writer {
  OptionTree tree = OptionTree::ofMap();

  template <class T>
  void operator()(const char* key, T& field) {
    tree.set(key, write(static_cast<const T&>(field)));
  }
};

template <class T>
void read(const OptionTree& tree, const std::string& key, std::vector<T>& field) {
  requireList(tree, key);
  std::vector<T> values(tree.list.size());
  for (size_t i = 0; i < values.size(); ++i) read(tree.list[i], index(key, i), values[i]);
  field = std::move(values);
}

template <class T, size_t N>
void read(const OptionTree& tree, const std::string& key, std::array<T, N>& field) {
  requireLength(tree, key, N);
  for (size_t i = 0; i < N; ++i) read(tree.list[i], index(key, i), field[i]);
}

template <class T>
std::enable_if_t<HasVisit<T>::value> read(const OptionTree& tree, const std::string& key, T& field) {
  requireMap(tree, key);
  Reader reader{tree, key, {}};
  field.visit(reader);
  requireKnown(tree, key, reader.known);
  if constexpr (HasCheck<T>::value) {
    try {
      field.check();
    } catch (const BadInput& e) {
      if (key.empty()) throw;
      throw BadInput(key + ": " + e.what());
    }
  }
}

template <class T>
OptionTree write(const std::vector<T>& field) {
  OptionTree tree = OptionTree::ofList();
  for (const T& value : field) tree.list.push_back(write(value));
  return tree;
}

template <class T, size_t N>
OptionTree write(const std::array<T, N>& field) {
  OptionTree tree = OptionTree::ofList();
  for (const T& value : field) tree.list.push_back(write(value));
  return tree;
}

template <class T>
std::enable_if_t<HasVisit<T>::value, OptionTree> write(const T& field) {
  Writer writer;
  T copy = field;  // visit() is not const
  copy.visit(writer);
  return writer.tree;
}

}  // namespace options_detail

/// Sets the fields that `tree` names and calls check(). Throws BadInput on an unknown key (by its full dotted
/// name, with the known ones and the nearest), on a value of the wrong type, and what check() throws;
/// `options` is then unchanged.
template <class T>
void readOptions(const OptionTree& tree, T* options) {
  T result = *options;
  options_detail::read(tree, "", result);
  *options = std::move(result);
}

/// The defaults of T with what the file sets. Messages begin with the path.
template <class T>
T loadOptions(const std::string& yaml_path) {
  const OptionTree tree = loadYaml(yaml_path);
  T options;
  try {
    readOptions(tree, &options);
  } catch (const BadInput& e) {
    throw BadInput(yaml_path + ": " + e.what());
  }
  return options;
}

/// Every field with its value: the effective options.
template <class T>
OptionTree writeOptions(const T& options) {
  return options_detail::write(options);
}

}  // namespace monocular_eye_hand
