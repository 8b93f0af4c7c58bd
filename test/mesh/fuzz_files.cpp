// Damaged files of every kind: each must be read, or be refused with BadInput. Anything else is a failure,
// whose input is kept in a file that the output names.
//   test_model_fuzz_files [COUNT [SEED]]
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>

#include "fuzz_damage.h"
#include "fuzz_seeds.h"
#include "mesh_file.h"
#include "model/build_model.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/io/camera_file.h"
#include "monocular_eye_hand/mesh/load_mesh.h"
#include "monocular_eye_hand/model/model_base.h"
#include "monocular_eye_hand/options/options.h"

namespace monocular_eye_hand::fuzz {
namespace {

int given_count = 400;
int given_seed = 1;

constexpr size_t kMaxTriangles = 300;  // of a mesh that is also made a model
constexpr int kMaxSeconds = 20;  // of the processor, for one input; of the reader of OBJ and DAE its own
constexpr size_t kMaxMemory = size_t(8) << 30;
constexpr size_t kMaxFailures = 20;
constexpr int kWrongException = 9;  // exit code

struct FuzzedOptions {
  ModelOptions model;
  ViewOptions views;
  std::string name;
  std::vector<std::vector<int>> corners;
  std::array<double, 3> box{};

  template <class Visitor>
  void visit(Visitor&& v) {
    v("model", model);
    v("views", views);
    v("name", name);
    v("corners", corners);
    v("box", box);
  }
};

void loadMeshFile(const std::string& path) {
  const LoadedMesh loaded = readMesh(path, "mm");
  if (loaded.mesh.triangles.size() > kMaxTriangles) return;
  ModelOptions options;
  options.find_symmetries = false;  // takes long, and sees no more of the file
  buildModel("part", loaded.mesh, options);
}

void loadOptionsFile(const std::string& path) {
  const OptionTree tree = loadYaml(path);
  if (parseYaml(toYaml(tree)) != tree) throw std::logic_error("the YAML that was written reads differently");
  try {
    loadOptions<FuzzedOptions>(path);
  } catch (const BadInput&) {
    // Of YAML that is none of these options the tree was read.
  }
}

/// What is damaged together, and who reads it.
struct Family {
  std::string name;
  std::vector<SeedFile> seeds;
  std::function<void(const std::string& path)> load;
  size_t share;  // of the inputs, in twelfths
};

std::vector<Family> families() {
  return {{"meshes", meshSeeds(), loadMeshFile, 7},
          {"calibrations", calibrationSeeds(), [](const std::string& path) { readCameraFile(path); }, 3},
          {"object lists", objectListSeeds(), [](const std::string& path) { readObjectEntries(path); }, 1},
          {"options", optionSeeds(), loadOptionsFile, 1}};
}

struct Input {
  size_t family;
  std::string extension, bytes;
};

class Inputs {
 public:
  Inputs() : families_(families()) {
    for (const Family& family : families_) {
      for (const SeedFile& seed : family.seeds) all_.push_back(seed.bytes);
    }
  }

  const std::vector<Family>& list() const { return families_; }

  /// The same for the same seed and index, whatever came before.
  Input at(size_t index) const {
    Dice dice(uint64_t(given_seed) << 32 ^ index);
    Input out{familyOf(index % 12), "", ""};
    const SeedFile& seed = dice.of(families_[out.family].seeds);
    out.bytes = damaged(seed.bytes, all_, &dice);
    // Now and then under the name of another kind.
    out.extension = dice.oneIn(12) ? dice.of(families_[out.family].seeds).extension : seed.extension;
    return out;
  }

 private:
  size_t familyOf(size_t twelfth) const {
    size_t family = 0;
    while (twelfth >= families_[family].share) twelfth -= families_[family++].share;
    return family;
  }

  std::vector<Family> families_;
  std::vector<std::string> all_;
};

/// A folder for the inputs, with the mesh that lists of objects name.
class Folder {
 public:
  Folder() : path_(testing::TempDir() + "fuzz_files_" + std::to_string(getpid())) {
    std::filesystem::create_directory(path_);
    write("box.stl", binaryStl(shapes::box(40, 50, 60)));
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path_ + "/" + name, std::ios::binary) << bytes;
    return path_ + "/" + name;
  }

 private:
  std::string path_;
};

/// What the process that reads tells the one that watches it.
struct Shared {
  size_t index;
  size_t read[8], refused[8], of_reader[8];
  char problem[400];
};

class Runner {
 public:
  explicit Runner(const Inputs& inputs) : inputs_(inputs) {
    void* memory = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::runtime_error("no memory to share");
    shared_ = static_cast<Shared*>(memory);
  }
  ~Runner() { munmap(shared_, sizeof(Shared)); }
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  /// Reads the inputs from this one on in a process of its own. Returns how it ended, as waitpid() tells it.
  int run(size_t first, size_t count) {
    shared_->index = first;
    std::cout.flush();
    const pid_t child = fork();
    if (child == 0) {
      limitMemory();
      for (size_t k = first; k < count; ++k) runOne(k);
      _exit(0);
    }
    int status = -1;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
  }

  const Shared& told() const { return *shared_; }

 private:
  static void limitMemory() {
#ifndef __SANITIZE_ADDRESS__
    const rlimit limit{kMaxMemory, kMaxMemory};
    setrlimit(RLIMIT_AS, &limit);
#endif
  }

  static void limitTime(int seconds) {
    const itimerval once{{0, 0}, {seconds, 0}};
    setitimer(ITIMER_PROF, &once, nullptr);
  }

  void runOne(size_t index) {
    shared_->index = index;
    const Input input = inputs_.at(index);
    const std::string path = folder_.write("input." + input.extension, input.bytes);
    limitTime(kMaxSeconds);
    const bool good = load(path, input.family);
    limitTime(0);
    std::remove(path.c_str());
    if (!good) _exit(kWrongException);
  }

  /// False when it threw anything but a refusal.
  bool load(const std::string& path, size_t family) {
    try {
      inputs_.list()[family].load(path);
      ++shared_->read[family];
    } catch (const BadInput& e) {
      ++shared_->refused[family];
      if (std::strstr(e.what(), "reader of OBJ and DAE") || std::strstr(e.what(), "reading the file takes")) {
        ++shared_->of_reader[family];
        std::cout << "  input " << shared_->index << ": " << e.what() << std::endl;
      }
      return true;
    } catch (const std::exception& e) {
      std::snprintf(shared_->problem, sizeof shared_->problem, "%s", e.what());
      return false;
    }
    return true;
  }

  const Inputs& inputs_;
  Shared* shared_;
  Folder folder_;
};

std::string ended(int status, const Shared& told) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == kWrongException)
    return std::string("threw what is no refusal: ") + told.problem;
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGPROF)
    return "was not done after " + std::to_string(kMaxSeconds) + " s";
  if (WIFSIGNALED(status)) return "died of signal " + std::to_string(WTERMSIG(status));
  return "ended the process with exit code " + std::to_string(WEXITSTATUS(status));
}

std::string kept(const Input& input, size_t index) {
  const std::string path = testing::TempDir() + "fuzz_failed_" + std::to_string(given_seed) + "_" +
                           std::to_string(index) + "." + input.extension;
  std::ofstream(path, std::ios::binary) << input.bytes;
  return path;
}

TEST(FuzzFiles, EveryInputIsReadOrRefused) {
  const Inputs inputs;
  Runner runner(inputs);
  size_t failures = 0;
  for (size_t next = 0; next < size_t(given_count) && failures < kMaxFailures;) {
    const int status = runner.run(next, size_t(given_count));
    if (status == 0) break;
    const size_t index = runner.told().index;
    const Input input = inputs.at(index);
    ADD_FAILURE() << "input " << index << " (" << inputs.list()[input.family].name << ") "
                  << ended(status, runner.told()) << "; it is kept in " << kept(input, index);
    ++failures;
    next = index + 1;
  }

  const Shared& told = runner.told();
  for (size_t f = 0; f < inputs.list().size(); ++f) {
    std::cout << inputs.list()[f].name << ": " << told.read[f] << " read, " << told.refused[f]
              << " refused, of these " << told.of_reader[f] << " because the process that runs assimp died"
              << std::endl;
    if (given_count < 200) continue;
    EXPECT_GT(told.read[f], 0u) << inputs.list()[f].name << ": all damage, nothing to read";
  }
  std::cout << failures << " failures over " << given_count << " inputs" << std::endl;
}

TEST(FuzzFiles, TheSeedsAreRead) {
  const Folder folder;
  for (const Family& family : families()) {
    for (const SeedFile& seed : family.seeds) {
      const std::string path = folder.write("seed." + seed.extension, seed.bytes);
      try {
        family.load(path);
      } catch (const BadInput& e) {
        ADD_FAILURE() << family.name << ": " << e.what();
      }
    }
  }
}

}  // namespace
}  // namespace monocular_eye_hand::fuzz

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc > 1) monocular_eye_hand::fuzz::given_count = std::atoi(argv[1]);
  if (argc > 2) monocular_eye_hand::fuzz::given_seed = std::atoi(argv[2]);
  return RUN_ALL_TESTS();
}
