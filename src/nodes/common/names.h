#pragma once

namespace monocular_eye_hand {
namespace names {

// Relative names: remap them or start the node in a namespace. "~" names lie below the node's own name.
constexpr char kImageRaw[] = "image_raw";
constexpr char kImageRect[] = "image_rect";
constexpr char kCameraInfo[] = "camera_info";
constexpr char kRecognizedObjects[] = "recognizer/objects";
constexpr char kAskRecognizer[] = "recognizer/recognize";

constexpr char kObjects[] = "objects";      // ~objects
constexpr char kMarkers[] = "markers";      // ~markers
constexpr char kOverlay[] = "overlay";      // ~overlay
constexpr char kView[] = "view";            // ~view
constexpr char kRecognize[] = "recognize";  // ~recognize

constexpr char kLocatedObjects[] = "eye_hand/objects";
constexpr char kPick[] = "pick";        // ~pick
constexpr char kPlace[] = "place";      // ~place
constexpr char kMove[] = "move";        // ~move
constexpr char kRecover[] = "recover";  // ~recover
constexpr char kPath[] = "path";        // ~path
constexpr char kCell[] = "cell";        // ~cell

constexpr char kBestGrasps[] = "best_grasps";      // ~best_grasps
constexpr char kGraspPoses[] = "grasp_poses";      // ~grasp_poses
constexpr char kGraspTargets[] = "grasp_targets";  // ~grasp_targets
constexpr char kForget[] = "forget";               // ~forget

// The cell: an arm, its gripper and its camera, real or simulated.
constexpr char kJointStates[] = "joint_states";
constexpr char kArmCommand[] = "arm_controller/command";
constexpr char kGripperCommand[] = "gripper/command";
constexpr char kGripperState[] = "gripper/state";
constexpr char kCellImage[] = "camera/image_raw";
constexpr char kCellCameraInfo[] = "camera/camera_info";
constexpr char kTruth[] = "truth";         // ~truth
constexpr char kTakeAway[] = "take_away";  // ~take_away

// Frames and joints of urdf/puma560.urdf; the arm's joints are armJointNames().
constexpr char kBaseFrame[] = "base_link";
constexpr char kCameraFrame[] = "camera_optical_frame";
// Each stands at half the opening.
constexpr const char* kFingerJoints[] = {"finger_left_joint", "finger_right_joint"};

}  // namespace names
}  // namespace monocular_eye_hand
