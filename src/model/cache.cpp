#include "model/cache.h"

#include <fmt/format.h>

#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <type_traits>

namespace monocular_eye_hand {
namespace {

constexpr char kMagic[9] = "MEHCACHE";
constexpr uint32_t kFormat = 5;  // raise when the layout or what fills it changes

/// FNV-1a (Fowler, Noll, Vo), 64 bit.
uint64_t hash(const std::string& bytes, uint64_t state = 0xcbf29ce484222325ull) {
  for (const char c : bytes) {
    state ^= uint64_t(static_cast<unsigned char>(c));
    state *= 0x100000001b3ull;
  }
  return state;
}

/// Appends plain values in this machine's byte order: the cache never leaves the machine.
class Writer {
 public:
  template <class T>
  void operator()(const T& value) {
    static_assert(std::is_arithmetic<T>::value, "plain numbers only");
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void operator()(const Eigen::Vector3d& v) {
    for (int k = 0; k < 3; ++k) (*this)(v[k]);
  }
  void operator()(const Rigid3& m) {
    for (int k = 0; k < 9; ++k) (*this)(m.rotation(k / 3, k % 3));
    (*this)(m.translation);
  }
  template <class T>
  void operator()(const std::vector<T>& list) {
    (*this)(uint64_t(list.size()));
    for (const T& item : list) (*this)(item);
  }
  void operator()(const NearSymmetry& t) {
    (*this)(t.motion);
    (*this)(t.differing);
  }
  void operator()(const ContourSample& s) {
    (*this)(s.p);
    (*this)(s.tangent);
    (*this)(int32_t(s.feature));
    (*this)(int8_t(s.silhouette));
    (*this)(int8_t(s.inner_side));
  }
  void operator()(const SampledView& v) {
    (*this)(v.direction);
    (*this)(v.distance);
    (*this)(v.contour);
    (*this)(int32_t(v.characteristic_view));
  }
  void operator()(const CharacteristicView& c) {
    (*this)(c.views);
    (*this)(c.features);
    (*this)(c.visible);
    (*this)(c.weight);
  }
  std::string bytes;
};

/// The same in reverse; a read past the end clears `good`.
class Reader {
 public:
  explicit Reader(const std::string& bytes) : bytes_(bytes) {}
  template <class T>
  void operator()(T* value) {
    static_assert(std::is_arithmetic<T>::value, "plain numbers only");
    if (bytes_.size() - at_ < sizeof *value) {
      good = false;
      *value = T();
      return;
    }
    std::memcpy(value, bytes_.data() + at_, sizeof *value);
    at_ += sizeof *value;
  }
  void operator()(Eigen::Vector3d* v) {
    for (int k = 0; k < 3; ++k) (*this)(&(*v)[k]);
  }
  void operator()(Rigid3* m) {
    for (int k = 0; k < 9; ++k) (*this)(&m->rotation(k / 3, k % 3));
    (*this)(&m->translation);
  }
  template <class T>
  void operator()(std::vector<T>* list) {
    uint64_t size = 0;
    (*this)(&size);
    good = good && size <= bytes_.size() - at_;  // every item takes at least a byte
    list->clear();
    for (uint64_t k = 0; good && k < size; ++k) {
      list->emplace_back();
      (*this)(&list->back());
    }
  }
  void operator()(NearSymmetry* t) {
    (*this)(&t->motion);
    (*this)(&t->differing);
  }
  void operator()(ContourSample* s) {
    int32_t feature = 0;
    int8_t silhouette = 0, side = 0;
    (*this)(&s->p);
    (*this)(&s->tangent);
    (*this)(&feature);
    (*this)(&silhouette);
    (*this)(&side);
    s->feature = feature;
    s->silhouette = silhouette != 0;
    s->inner_side = int(side);
  }
  void operator()(SampledView* v) {
    int32_t view = 0;
    (*this)(&v->direction);
    (*this)(&v->distance);
    (*this)(&v->contour);
    (*this)(&view);
    v->characteristic_view = view;
  }
  void operator()(CharacteristicView* c) {
    (*this)(&c->views);
    (*this)(&c->features);
    (*this)(&c->visible);
    (*this)(&c->weight);
  }
  bool atEnd() const { return at_ == bytes_.size(); }
  bool good = true;

 private:
  const std::string& bytes_;
  size_t at_ = 0;
};

std::string pack(const CompiledParts& parts) {
  Writer w;
  const Symmetries& s = parts.symmetries.symmetries;
  w(s.discrete);
  w(int8_t(s.axis.has_value()));
  w(s.axis ? s.axis->point : Eigen::Vector3d(0, 0, 0));
  w(s.axis ? s.axis->direction : Eigen::Vector3d(0, 0, 0));
  w(int8_t(s.sphere));
  w(parts.symmetries.twins);
  w(parts.views.distances);
  w(parts.views.step);
  w(int32_t(parts.views.directions));
  w(parts.views.views);
  w(parts.views.characteristic);
  return std::move(w.bytes);
}

bool unpack(const std::string& bytes, CompiledParts* parts) {
  Reader r(bytes);
  Symmetries& s = parts->symmetries.symmetries;
  int8_t has_axis = 0, sphere = 0;
  int32_t directions = 0;
  SymmetryAxis axis;

  r(&s.discrete);
  r(&has_axis);
  r(&axis.point);
  r(&axis.direction);
  r(&sphere);
  r(&parts->symmetries.twins);
  r(&parts->views.distances);
  r(&parts->views.step);
  r(&directions);
  r(&parts->views.views);
  r(&parts->views.characteristic);

  if (has_axis) s.axis = axis;
  s.sphere = sphere != 0;
  parts->views.directions = directions;
  return r.good && r.atEnd();
}

void makeFolders(const std::string& folder) {
  for (size_t slash = folder.find('/', 1); slash != std::string::npos; slash = folder.find('/', slash + 1)) {
    mkdir(folder.substr(0, slash).c_str(), 0777);
  }
  mkdir(folder.c_str(), 0777);
}

}  // namespace

std::string cacheFolder(const std::string& wanted) {
  if (wanted == "none") return "";
  if (!wanted.empty()) return wanted;
  // The standard says: a relative XDG_CACHE_HOME is to be ignored.
  const char* xdg = std::getenv("XDG_CACHE_HOME");
  if (xdg && xdg[0] == '/') return std::string(xdg) + "/monocular_eye_hand";
  const char* home = std::getenv("HOME");
  if (home && home[0] == '/') return std::string(home) + "/.cache/monocular_eye_hand";
  return "";
}

std::string cacheName(const std::string& mesh_bytes, const std::string& options_text) {
  const uint64_t options = hash(options_text + "|" + std::to_string(kFormat));
  char name[64];
  std::snprintf(name, sizeof name, "%016llx%016llx.cache", (unsigned long long)(hash(mesh_bytes, options)),
                (unsigned long long)(hash(options_text, hash(mesh_bytes))));
  return name;
}

bool readCache(const std::string& path, CompiledParts* parts) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return false;
  std::ostringstream all;
  all << in.rdbuf();
  const std::string bytes = all.str();
  constexpr size_t kHeader = 8 + sizeof(uint32_t) + sizeof(uint64_t);
  if (bytes.size() < kHeader || bytes.compare(0, 8, kMagic, 8) != 0) return false;
  uint32_t format;
  uint64_t checksum;
  std::memcpy(&format, bytes.data() + 8, sizeof format);
  std::memcpy(&checksum, bytes.data() + 8 + sizeof format, sizeof checksum);
  const std::string payload = bytes.substr(kHeader);
  if (format != kFormat || checksum != hash(payload)) return false;
  CompiledParts read;
  if (!unpack(payload, &read)) return false;
  *parts = std::move(read);
  return true;
}

bool writeCache(const std::string& folder, const std::string& name, const CompiledParts& parts) {
  makeFolders(folder);
  const std::string payload = pack(parts), path = folder + "/" + name;
  const uint32_t format = kFormat;
  const uint64_t checksum = hash(payload);
  const std::string temporary = fmt::format("{}.{}.part", path, getpid());

  {
    std::ofstream out(temporary, std::ios::binary);
    out.write(kMagic, 8);
    out.write(reinterpret_cast<const char*>(&format), sizeof format);
    out.write(reinterpret_cast<const char*>(&checksum), sizeof checksum);
    out.write(payload.data(), std::streamsize(payload.size()));
    out.close();
    if (!out) {
      std::remove(temporary.c_str());
      return false;
    }
  }

  if (std::rename(temporary.c_str(), path.c_str()) == 0) return true;
  std::remove(temporary.c_str());
  return false;
}

}  // namespace monocular_eye_hand
