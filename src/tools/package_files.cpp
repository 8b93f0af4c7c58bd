#include "tools/package_files.h"

#include <filesystem>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {
namespace {

namespace fs = std::filesystem;

bool isPackage(const fs::path& folder) {
  std::error_code ignored;
  return fs::exists(folder / "config" / "objects.yaml", ignored) && fs::exists(folder / "urdf", ignored);
}

}  // namespace

std::string packageFolder() {
  // PREFIX/bin/PROGRAM, or with ROS PREFIX/lib/monocular_eye_hand/PROGRAM.
  std::error_code ignored;
  fs::path prefix = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (int up = 0; up < 2; ++up) {
    prefix = prefix.parent_path();
    const fs::path share = prefix / "share" / "monocular_eye_hand";
    if (isPackage(share)) return share.string();
  }

  const fs::path sources = MONOCULAR_EYE_HAND_SOURCE_DIR;
  if (isPackage(sources)) return sources.string();
  throw BadInput("the package's config and urdf are neither in " + prefix.string() + " nor in " +
                 sources.string() + ": give --config and --urdf");
}

}  // namespace monocular_eye_hand
