#pragma once
#include <string>
#include <vector>

namespace monocular_eye_hand {

/// Whether the name ends as that of a still image that OpenCV reads.
bool isImageFile(const std::string& path);

/// The image files that an argument names: a file (whether or not it exists); a folder: its image files in
/// the order of their names, numbers by value (img2 before img10); a printf pattern with one integer
/// (img_%04d.png): the files that match, by number. Throws BadInput when a folder or pattern names no image,
/// or the pattern is not understood.
std::vector<std::string> imageFiles(const std::string& argument);

}  // namespace monocular_eye_hand
