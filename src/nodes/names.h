#pragma once

namespace monocular_eye_hand {
namespace names {

// Relative names: remap them or start the node in a namespace. "~" names lie below the node's own name.
constexpr char kImageRaw[] = "image_raw";
constexpr char kImageRect[] = "image_rect";
constexpr char kCameraInfo[] = "camera_info";

constexpr char kObjects[] = "objects";      // ~objects
constexpr char kMarkers[] = "markers";      // ~markers
constexpr char kOverlay[] = "overlay";      // ~overlay
constexpr char kRecognize[] = "recognize";  // ~recognize

}  // namespace names
}  // namespace monocular_eye_hand
