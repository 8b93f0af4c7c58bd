#include "model/symmetry_group.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace monocular_eye_hand {
namespace {

using Turns = std::vector<Eigen::Matrix3d>;

double apart(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return Eigen::AngleAxisd(a.transpose() * b).angle();
}

Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& m) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1);
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

/// Adds products until there are no new ones; false when they become too many.
bool close(const std::function<bool(const Eigen::Matrix3d&)>& holds, size_t max_rotations, Turns* turns) {
  for (size_t i = 0; i < turns->size(); ++i) {
    for (size_t j = 0; j <= i; ++j) {
      const Eigen::Matrix3d products[2] = {(*turns)[i] * (*turns)[j], (*turns)[j] * (*turns)[i]};
      for (const Eigen::Matrix3d& product : products) {
        if (indexOfTurn(*turns, product) >= 0) continue;
        if (turns->size() >= max_rotations || !holds(product)) return false;
        turns->push_back(product);
      }
    }
  }
  return true;
}

/// table[i][j] is the element that the product of i and j is; empty when two products of a row are the same,
/// so that this is no group.
std::vector<std::vector<int>> productTable(const Turns& turns) {
  std::vector<std::vector<int>> table(turns.size(), std::vector<int>(turns.size(), -1));
  for (size_t i = 0; i < turns.size(); ++i) {
    std::vector<char> seen(turns.size(), 0);
    for (size_t j = 0; j < turns.size(); ++j) {
      const int k = indexOfTurn(turns, turns[i] * turns[j]);
      if (k < 0 || seen[size_t(k)]) return {};
      seen[size_t(k)] = 1;
      table[i][j] = k;
    }
  }
  return table;
}

/// Replaces every element k by the mean of inverse(i) (i k) over all i. Converges quadratically.
void makeExact(const std::vector<std::vector<int>>& table, Turns* turns) {
  constexpr int kMaxRounds = 20;
  for (int round = 0; round < kMaxRounds; ++round) {
    Turns sums(turns->size(), Eigen::Matrix3d::Zero());
    for (size_t i = 0; i < turns->size(); ++i) {
      for (size_t k = 0; k < turns->size(); ++k)
        sums[k] += (*turns)[i].transpose() * (*turns)[size_t(table[i][k])];
    }
    double moved = 0;
    for (size_t k = 0; k < turns->size(); ++k) {
      const Eigen::Matrix3d mean = nearestRotation(sums[k]);
      moved = std::max(moved, (mean - (*turns)[k]).norm());
      (*turns)[k] = mean;
    }
    if (moved < 1e-14) break;
  }
  turns->front().setIdentity();
}

}  // namespace

int indexOfTurn(const std::vector<Eigen::Matrix3d>& list, const Eigen::Matrix3d& rotation) {
  int best = -1;
  double min_angle = kSameRotation;
  for (size_t k = 0; k < list.size(); ++k) {
    const double angle = apart(list[k], rotation);
    if (angle >= min_angle) continue;
    min_angle = angle;
    best = int(k);
  }
  return best;
}

std::optional<std::vector<Eigen::Matrix3d>> grownGroup(
    const std::vector<Eigen::Matrix3d>& group, const Eigen::Matrix3d& more,
    const std::function<bool(const Eigen::Matrix3d&)>& holds, size_t max_rotations) {
  Turns turns = group;
  turns.push_back(more);
  if (!close(holds, max_rotations, &turns)) return std::nullopt;
  const std::vector<std::vector<int>> table = productTable(turns);
  if (table.empty()) return std::nullopt;
  makeExact(table, &turns);
  if (!std::all_of(turns.begin() + 1, turns.end(), holds)) return std::nullopt;
  return turns;
}

void sortTurns(std::vector<Eigen::Matrix3d>* group) {
  const auto before = [](const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
    if (std::abs(a.trace() - b.trace()) > 1e-6) return a.trace() > b.trace();
    for (int k = 0; k < 9; ++k) {
      const double d = a(k / 3, k % 3) - b(k / 3, k % 3);
      if (std::abs(d) > 1e-6) return d > 0;
    }
    return false;
  };
  std::stable_sort(group->begin() + 1, group->end(), before);
}

}  // namespace monocular_eye_hand
