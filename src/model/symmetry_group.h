#pragma once
#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

namespace monocular_eye_hand {

/// Rotations closer than this are one: half of a 60-fold turn [rad].
constexpr double kSameRotation = 0.06;

/// Index of the rotation of the list that is nearest to `rotation` and within kSameRotation; -1 without one.
int indexOfTurn(const std::vector<Eigen::Matrix3d>& list, const Eigen::Matrix3d& rotation);

/// The smallest finite group of rotations that holds `group` (a group, identity first) and `more`. Products
/// are made exact: every element becomes the mean of what the others say of it (repeated), so that measured
/// rotations become a group to machine precision. `holds` is asked of every element in the
/// end. Nothing when there is no such group of at most `most` elements, or one of them does not hold.
std::optional<std::vector<Eigen::Matrix3d>> grownGroup(
    const std::vector<Eigen::Matrix3d>& group, const Eigen::Matrix3d& more,
    const std::function<bool(const Eigen::Matrix3d&)>& holds, size_t max_rotations);

/// Identity first, then by falling trace, then by the entries: a repeatable order.
void sortTurns(std::vector<Eigen::Matrix3d>* group);

}  // namespace monocular_eye_hand
