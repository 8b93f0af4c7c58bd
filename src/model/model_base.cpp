#include "monocular_eye_hand/model/model_base.h"

#include <algorithm>
#include <sstream>

#include "build_model.h"
#include "cache.h"
#include "look_alikes.h"
#include "mesh_readers.h"
#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

/// Every option that changes what is cached, spelled exactly.
class SpellOptions {
 public:
  template <class T>
  void operator()(const char* name, const T& value) {
    out_ << name << '=';
    spell(value);
    out_ << ';';
  }
  std::string text() const { return out_.str(); }

 private:
  template <class T>
  void spell(const T& value) {
    out_ << std::hexfloat << value;
  }
  void spell(const std::vector<double>& list) {
    for (const double value : list) out_ << std::hexfloat << value << ',';
  }
  std::ostringstream out_;
};

std::string spelled(const ObjectEntry& entry, ViewOptions views) {
  SpellOptions spell;
  ModelOptions options = entry.options;
  options.visit(spell);
  views.visit(spell);
  return "unit=" + entry.unit + ";" + spell.text();
}

KnownObject compile(const ObjectEntry& entry, const ViewOptions& views, const std::string& folder) {
  LoadedMesh loaded = readMesh(entry.mesh, entry.unit);
  KnownObject object;
  object.model = buildShape(entry.name, loaded.mesh, entry.options);
  std::vector<std::string>& warnings = object.model.warnings;
  warnings.insert(warnings.begin(), loaded.warnings.begin(), loaded.warnings.end());
  CompiledParts parts;
  const std::string name = folder.empty() ? "" : cacheName(readFileBytes(entry.mesh), spelled(entry, views));
  const bool cached = !folder.empty() && readCache(folder + "/" + name, &parts);
  if (!cached) parts.symmetries = symmetriesOf(object.model, entry.options);
  setSymmetries(parts.symmetries, &object.model);
  if (!cached) {
    parts.views = sampleViews(object.model, views);
    if (!folder.empty()) writeCache(folder, name, parts);
  }
  object.views = std::move(parts.views);
  object.handling = entry.handling;
  return object;
}

}  // namespace

int ModelBase::indexOf(const std::string& name) const {
  for (size_t k = 0; k < objects.size(); ++k) {
    if (objects[k].model.name == name) return int(k);
  }
  return -1;
}

std::string ModelBase::names() const {
  std::string out;
  for (const KnownObject& o : objects) out += (out.empty() ? "" : ", ") + o.model.name;
  return out;
}

ModelBase compileModelBase(const std::vector<ObjectEntry>& entries, const ViewOptions& views,
                           const std::string& cache_dir) {
  views.check();
  const std::string folder = cacheFolder(cache_dir);
  ModelBase base;
  for (const ObjectEntry& entry : entries) {
    if (base.indexOf(entry.name) >= 0) throw BadInput("the object name \"" + entry.name + "\" is used twice");
    base.objects.push_back(compile(entry, views, folder));
  }
  warnAboutLookAlikes(&base);
  return base;
}

ModelBase loadModelBase(const std::string& yaml_path, const ViewOptions& views,
                        const std::string& cache_dir) {
  return compileModelBase(readObjectEntries(yaml_path), views, cache_dir);
}

}  // namespace monocular_eye_hand
