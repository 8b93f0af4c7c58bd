#include "monocular_eye_hand/model/model_base.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "model/build_steps.h"
#include "model/cache.h"
#include "model/similar_models.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/mesh/load_mesh.h"

namespace monocular_eye_hand {
namespace {

constexpr size_t kSlowTriangles = 50000;  // their edges take seconds, whether or not the rest is cached

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

/// Where compiled parts are kept; "" as folder: nowhere.
struct Cache {
  std::string folder;
  bool failed = false;  // something could not be written
};

/// Symmetries and views, the slow part, from the cache or made anew; the views, where they are wanted. Enters
/// the symmetries, which the views depend on, into the model.
ViewSphere compiledViews(const ObjectEntry& entry, ModelDepth depth, const ViewOptions& views, Cache* cache,
                         const CompileProgress& reportProgress, ObjectModel* model) {
  CompiledParts parts;
  const std::string& folder = cache->folder;
  const std::string name = folder.empty() ? "" : cacheName(meshFileBytes(entry.mesh), spelled(entry, views));
  const bool cached = !folder.empty() && readCache(folder + "/" + name, &parts);
  if (!cached) {
    reportProgress("looking for symmetries");
    parts.symmetries = symmetriesOf(*model, entry.options);
  }
  setSymmetries(parts.symmetries, model);
  if (depth < ModelDepth::kViews) return {};
  if (cached) return std::move(parts.views);

  reportProgress("looking from all sides");
  parts.views = sampleViews(*model, views);
  if (!folder.empty() && !writeCache(folder, name, parts)) cache->failed = true;
  return std::move(parts.views);
}

KnownObject compile(const ObjectEntry& entry, ModelDepth depth, const ViewOptions& views, Cache* cache,
                    const CompileProgress& progress) {
  LoadedMesh loaded = readMesh(entry.mesh, entry.unit);
  KnownObject object;
  object.handling = entry.handling;
  if (depth == ModelDepth::kMesh) {
    object.model = repairedModel(entry.name, loaded.mesh, entry.options).model;
    object.model.warnings = std::move(loaded.warnings);
    return object;
  }

  const size_t triangles = loaded.mesh.triangles.size();
  const auto reportProgress = [&](const std::string& step) {
    if (progress) progress(fmt::format("{} ({} triangles): {}", entry.name, triangles, step));
  };
  if (triangles > kSlowTriangles) reportProgress("looking for edges");
  object.model = buildShape(entry.name, loaded.mesh, entry.options);
  std::vector<std::string>& warnings = object.model.warnings;
  warnings.insert(warnings.begin(), loaded.warnings.begin(), loaded.warnings.end());

  object.views = compiledViews(entry, depth, views, cache, reportProgress, &object.model);
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

ModelBase compileModels(const std::vector<ObjectEntry>& entries, ModelDepth depth, const ViewOptions& views,
                        const std::string& cache_dir, const CompileProgress& progress) {
  views.check();
  Cache cache{cacheFolder(cache_dir)};
  ModelBase base;
  for (const ObjectEntry& entry : entries) {
    if (base.indexOf(entry.name) >= 0) throw BadInput("the object name \"" + entry.name + "\" is used twice");
    base.objects.push_back(compile(entry, depth, views, &cache, progress));
  }
  if (cache.failed && progress)
    progress(
        "the cache of compiled models, " + cache.folder +
        ", cannot be written: they are compiled at every start. Make the folder writable, or name another "
        "one (the parameter cache of the nodes, XDG_CACHE_HOME)");
  if (depth > ModelDepth::kMesh) warnAboutSimilarModels(&base);
  return base;
}

ModelBase loadModels(const std::string& yaml_path, ModelDepth depth, const ViewOptions& views,
                     const std::string& cache_dir, const CompileProgress& progress) {
  return compileModels(readObjectEntries(yaml_path), depth, views, cache_dir, progress);
}

}  // namespace monocular_eye_hand
