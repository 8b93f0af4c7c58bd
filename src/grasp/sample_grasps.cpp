#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "boxes.h"
#include "contact.h"
#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/grasp/model_grasps.h"
#include "monocular_eye_hand/model/equal_poses.h"

namespace monocular_eye_hand {
namespace {

/// Where the hand may stand: places in the plane half way between the pads, with a direction to close along.
struct Site {
  Eigen::Vector3d closing = Eigen::Vector3d::UnitY();
  Eigen::Vector3d approach = Eigen::Vector3d::UnitZ();
  std::vector<Eigen::Vector3d> places;
  double width = 0;
  std::string source;
};

Rigid3 tcpAt(const Eigen::Vector3d& place, const Eigen::Vector3d& closing, const Eigen::Vector3d& approach) {
  Rigid3 pose;
  pose.rotation << closing.cross(approach), closing, approach;
  pose.translation = place;
  return pose;
}

Eigen::AlignedBox2d extentOf(const ObjectModel& model, const Surface& surface, const Eigen::Vector3d& u,
                             const Eigen::Vector3d& v) {
  Eigen::AlignedBox2d box;
  for (const int t : surface.triangles)
    for (const int i : model.mesh.triangles[size_t(t)]) {
      const Eigen::Vector3d& p = model.mesh.vertices[size_t(i)];
      box.extend(Eigen::Vector2d(u.dot(p), v.dot(p)));
    }
  return box;
}

/// Evenly over an interval, its middle among them.
std::vector<double> spread(double low, double high, double step) {
  const int sides = std::max(0, int((high - low) / 2 / step));
  std::vector<double> values;
  for (int k = -sides; k <= sides; ++k) values.push_back((low + high) / 2 + k * step);
  return values;
}

/// A direction in the face that fits its shape: along its longest straight edge.
Eigen::Vector3d mainDirection(const ObjectModel& model, int surface) {
  const Eigen::Vector3d normal = model.surfaces[size_t(surface)].axis;
  Eigen::Vector3d best = normal.unitOrthogonal();
  double longest = 0;
  for (const ModelEdge& edge : model.edges) {
    const Eigen::Vector3d d = edge.q - edge.p;
    if (edge.surface[0] != surface && edge.surface[1] != surface) continue;
    if (d.norm() > longest + 1e-9) {
      longest = d.norm();
      best = d.normalized();
    }
  }
  return (best - normal * normal.dot(best)).normalized();
}

std::vector<Site> facePairs(const ObjectModel& model, const GripperOptions& gripper,
                            const GraspSamplingOptions& options) {
  std::vector<Site> sites;
  for (size_t a = 0; a < model.surfaces.size(); ++a) {
    for (size_t b = a + 1; b < model.surfaces.size(); ++b) {
      const Surface &first = model.surfaces[a], &second = model.surfaces[b];
      if (first.kind != Surface::Kind::kPlane || second.kind != Surface::Kind::kPlane) continue;
      if (first.axis.dot(second.axis) > -std::cos(options.max_face_angle)) continue;
      const Eigen::Vector3d n = first.axis;
      const double width = n.dot(first.point - second.point);  // negative: they face each other
      if (width < std::max(gripper.opening_min, 2 * gripper.compliance) ||
          width + 2 * options.margin > gripper.opening_max)
        continue;

      const Eigen::Vector3d u = mainDirection(model, int(a)), v = n.cross(u);
      const Eigen::AlignedBox2d box =
          extentOf(model, first, u, v).intersection(extentOf(model, second, u, v));
      if (box.isEmpty()) continue;
      const double middle = n.dot(first.point) - width / 2;
      const bool round =
          model.symmetries.axis && std::abs(model.symmetries.axis->direction.dot(n)) > 1 - 1e-6;

      for (int k = 0; k < (round ? 1 : options.directions); ++k) {
        const double angle = 2 * M_PI * k / options.directions;
        Site site;
        site.closing = n;
        site.approach = std::cos(angle) * u + std::sin(angle) * v;
        site.width = width;
        site.source = fmt::format("faces {} and {}", a, b);
        if (round) {  // other places and directions are this line, turned
          const Eigen::Vector3d& p = model.symmetries.axis->point;
          for (const double s : spread(box.min().x(), box.max().x(), options.step))
            site.places.push_back(s * u + v.dot(p) * v + middle * n);
        } else {
          for (const double s : spread(box.min().x(), box.max().x(), options.step))
            for (const double t : spread(box.min().y(), box.max().y(), options.step))
              site.places.push_back(s * u + t * v + middle * n);
        }
        sites.push_back(std::move(site));
      }
    }
  }
  return sites;
}

std::vector<Site> cylinders(const ObjectModel& model, const GripperOptions& gripper,
                            const GraspSamplingOptions& options) {
  std::vector<Site> sites;
  for (size_t c = 0; c < model.surfaces.size(); ++c) {
    const Surface& s = model.surfaces[c];
    if (s.kind != Surface::Kind::kCylinder || !s.convex) continue;
    const double width = 2 * s.radius;
    if (width < std::max(gripper.opening_min, 2 * gripper.compliance) ||
        width + 2 * options.margin > gripper.opening_max)
      continue;

    const bool round = model.symmetries.axis &&
                       std::abs(model.symmetries.axis->direction.dot(s.axis)) > 1 - 1e-6 &&
                       (model.symmetries.axis->point - s.point).cross(s.axis).norm() < 1e-6;
    const Eigen::Vector3d u = s.axis.unitOrthogonal(), v = s.axis.cross(u);

    Site site;
    site.width = width;
    site.source = fmt::format("cylinder {}", c);
    // Beyond the wall's ends too: the pads then hold its rim.
    const double reach = s.half_length + gripper.pad_length / 2;
    for (const double t : spread(-reach, reach, options.step / 2))
      site.places.push_back(s.point + t * s.axis);

    for (int k = 0; k < (round ? 1 : options.directions); ++k) {
      const double angle = 2 * M_PI * k / options.directions;
      const Eigen::Vector3d across = std::cos(angle) * u + std::sin(angle) * v;
      site.approach = across;
      site.closing = s.axis.cross(across);
      sites.push_back(site);
      if (2 * k >= options.directions && !round) continue;  // closing from either side is the same
      site.closing = across;
      for (const double sign : {1.0, -1.0}) {
        site.approach = sign * s.axis;
        sites.push_back(site);
      }
    }
  }
  return sites;
}

double leverOf(const Rigid3& object_from_tcp, const Eigen::Vector3d& centre_of_mass) {
  return object_from_tcp.rotation.col(1).cross(centre_of_mass - object_from_tcp.translation).norm();
}

/// Contact, lever and quality; false when too little touches.
bool rate(const ObjectModel& model, const GripperOptions& gripper, const GraspSamplingOptions& options,
          const Eigen::Vector3d& centre_of_mass, ModelGrasp* grasp) {
  const PadContact contact = padContact(model, gripper, grasp->object_from_tcp, grasp->width);
  if (contact.share < options.min_contact) return false;
  grasp->contact = contact.share;
  grasp->lever = leverOf(grasp->object_from_tcp, centre_of_mass);
  grasp->quality = contact.share * contact.alignment *
                   (1 - options.lever_weight * std::min(1.0, 2 * grasp->lever / model.diameter));
  return true;
}

bool clearOfPart(const ObjectModel& model, const GripperOptions& gripper, const GraspSamplingOptions& options,
                 const ModelGrasp& grasp) {
  const double opening = grasp.width + 2 * options.margin;
  return !MeshInHand(model, grasp.object_from_tcp.inverse())
              .meets(sweptBoxes(gripper, opening, grasp.width, options.approach));
}

bool better(const ModelGrasp& a, const ModelGrasp& b) { return a.quality > b.quality + 1e-9; }

/// The best of one site, apart from each other by half a pad.
void keepBest(std::vector<ModelGrasp> of_site, const GripperOptions& gripper,
              const GraspSamplingOptions& options, std::vector<ModelGrasp>* kept) {
  std::stable_sort(of_site.begin(), of_site.end(), better);
  std::vector<ModelGrasp> best;
  for (const ModelGrasp& grasp : of_site) {
    if (int(best.size()) == options.per_direction) break;
    const bool apart = std::all_of(best.begin(), best.end(), [&](const ModelGrasp& other) {
      return (other.object_from_tcp.translation - grasp.object_from_tcp.translation).norm() >
             0.5 * std::min(gripper.pad_width, gripper.pad_length);
    });
    if (apart) best.push_back(grasp);
  }
  kept->insert(kept->end(), best.begin(), best.end());
}

/// What the object's symmetry, or the gripper's half turn, makes of a grasp that is kept already.
std::vector<ModelGrasp> distinct(const std::vector<ModelGrasp>& grasps, const ObjectModel& model,
                                 size_t max_count) {
  Rigid3 half_turn;
  half_turn.rotation.diagonal() << -1, -1, 1;
  std::vector<ModelGrasp> kept;
  std::vector<Rigid3> known;  // every symmetric form of those

  for (const ModelGrasp& grasp : grasps) {
    if (kept.size() == max_count) break;
    const bool old = std::any_of(known.begin(), known.end(), [&](const Rigid3& other) {
      return (other.translation - grasp.object_from_tcp.translation).norm() < 1e-4 &&
             (other.rotation - grasp.object_from_tcp.rotation).norm() < 1e-2;
    });
    if (old) continue;
    kept.push_back(grasp);
    for (const Rigid3& s : model.symmetries.discrete) {
      known.push_back(s * grasp.object_from_tcp);
      known.push_back(s * grasp.object_from_tcp * half_turn);
    }
  }
  return kept;
}

}  // namespace

Eigen::Vector3d centreOfMass(const ObjectModel& model) {
  const Eigen::Vector3d origin = model.centre();
  double volume = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (const auto& t : model.mesh.triangles) {
    const Eigen::Vector3d a = model.mesh.vertices[size_t(t[0])] - origin,
                          b = model.mesh.vertices[size_t(t[1])] - origin,
                          c = model.mesh.vertices[size_t(t[2])] - origin;
    const double v = a.dot(b.cross(c)) / 6;
    volume += v;
    moment += v * (a + b + c) / 4;
  }
  return model.closed && volume > 0 ? Eigen::Vector3d(origin + moment / volume) : origin;
}

ModelGrasps sampleGrasps(const ObjectModel& model, const GripperOptions& gripper,
                         const GraspSamplingOptions& options) {
  gripper.check();
  options.check();
  if (!model.rays) throw BadInput("grasps of " + model.name + ": the model is not built; use buildModel()");
  const Eigen::Vector3d centre_of_mass = centreOfMass(model);
  std::vector<Site> sites = facePairs(model, gripper, options);
  const std::vector<Site> round = cylinders(model, gripper, options);
  sites.insert(sites.end(), round.begin(), round.end());

  ModelGrasps result;
  int touching = 0;
  for (const Site& site : sites) {
    std::vector<ModelGrasp> of_site;
    for (const Eigen::Vector3d& place : site.places) {
      ModelGrasp grasp;
      grasp.object_from_tcp = tcpAt(place, site.closing, site.approach);
      grasp.width = site.width;
      grasp.source = site.source;
      if (!rate(model, gripper, options, centre_of_mass, &grasp)) continue;
      ++touching;
      if (clearOfPart(model, gripper, options, grasp)) of_site.push_back(grasp);
    }
    keepBest(std::move(of_site), gripper, options, &result.grasps);
  }
  std::stable_sort(result.grasps.begin(), result.grasps.end(), better);
  result.grasps = distinct(result.grasps, model, size_t(options.max_grasps));
  if (result.grasps.empty()) {
    result.reason = model.name + ": ";
    if (sites.empty())
      result.reason += fmt::format(
          "no parallel faces and no outer cylinder between {:g} and {:g} mm apart, which the gripper opens "
          "for; give grasps in the model base",
          1e3 * gripper.opening_min, 1e3 * (gripper.opening_max - 2 * options.margin));
    else if (touching == 0)
      result.reason +=
          fmt::format("at no place do the pads touch with {:g} % of their area", 100 * options.min_contact);
    else
      result.reason +=
          fmt::format("at each of the {} places where the pads touch, the hand meets the part", touching);
  }
  return result;
}

ModelGrasps graspsOf(const KnownObject& object, const GripperOptions& gripper,
                     const GraspSamplingOptions& options) {
  const ObjectModel& model = object.model;
  ModelGrasps result;
  if (object.handling.obstacle || !object.handling.grasp) {
    result.reason =
        model.name + (object.handling.obstacle ? " is an obstacle (obstacle: true in the model base)"
                                               : " must not be grasped (grasp: false in the model base)");
    return result;
  }
  if (object.handling.grasps.empty()) return sampleGrasps(model, gripper, options);

  gripper.check();
  options.check();
  const Eigen::Vector3d centre_of_mass = centreOfMass(model);
  for (size_t k = 0; k < object.handling.grasps.size(); ++k) {
    const GivenGrasp& given = object.handling.grasps[k];
    const std::string source = fmt::format("given {}", k);
    if (given.width < gripper.opening_min || given.width + 2 * options.margin > gripper.opening_max) {
      result.reason += fmt::format("{}{}: width {:g} mm does not fit the opening of {:g} to {:g} mm",
                                   result.reason.empty() ? model.name + ": " : "; ", source,
                                   1e3 * given.width, 1e3 * gripper.opening_min, 1e3 * gripper.opening_max);
      continue;
    }

    for (int step = 0; step < given.rotation_steps; ++step) {
      ModelGrasp grasp;
      grasp.object_from_tcp =
          rotationAbout(given.axis, 2 * M_PI * step / given.rotation_steps) * given.object_from_tcp;
      grasp.width = given.width;
      grasp.source = source;
      std::string fault;
      if (!rate(model, gripper, options, centre_of_mass, &grasp))
        fault = "the pads touch with less than min_contact of their area";
      else if (!clearOfPart(model, gripper, options, grasp))
        fault = "the hand meets the part";
      if (fault.empty()) {
        result.grasps.push_back(grasp);
      } else {
        result.reason += fmt::format("{}{}, turn {}: {}", result.reason.empty() ? model.name + ": " : "; ",
                                     source, step, fault);
      }
    }
  }

  std::stable_sort(result.grasps.begin(), result.grasps.end(), better);
  return result;
}

}  // namespace monocular_eye_hand
