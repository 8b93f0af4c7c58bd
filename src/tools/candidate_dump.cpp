#include "tools/candidate_dump.h"

#include <algorithm>
#include <fstream>
#include <ostream>
#include <set>

#include "monocular_eye_hand/evaluation/outcomes.h"
#include "monocular_eye_hand/geometry/error.h"
#include "tools/csv_table.h"

namespace monocular_eye_hand {

namespace {

constexpr double kSamePlace = 0.5;  // of the diameter: a pose nearer to the truth is in its place

void writePose(const Rigid3& pose, std::ostream* out) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) *out << ',' << pose.rotation(row, column);
  for (int i = 0; i < 3; ++i) *out << ',' << pose.translation[i];
}

void writeFate(int index, const JudgedCandidate& candidate, std::ostream* out) {
  *out << ',' << index << ',' << toString(candidate.fate) << ',';
  if (candidate.fate == Fate::kSuppressed) *out << candidate.suppressed_by;

  *out << ',';
  const char* separator = "";
  for (int conflict : candidate.conflicts) {
    *out << separator << conflict;
    separator = " ";
  }
  *out << ',' << candidate.kind << ',' << candidate.rank_score;
}

// rival:value:value... separated by spaces, the values in the order of PoseContest::visit.
void writeContests(const std::vector<std::pair<int, PoseContest>>& contests, std::ostream* out) {
  *out << ',';
  const char* separator = "";
  for (auto [rival, contest] : contests) {
    *out << separator << rival;
    contest.visit([out](const char*, double value) { *out << ':' << value; });
    separator = " ";
  }
}

}  // namespace

CandidateDump::Row CandidateDump::measured(const BopImage& image, const JudgedCandidate& candidate,
                                           int bop_object) const {
  Row row;
  row.scene = image.scene;
  row.image = image.id;
  row.bop_object = bop_object;
  row.candidate = candidate;
  for (size_t k = 0; k < image.truth.size(); ++k) {
    if (image.truth[k].object != bop_object) continue;
    const PoseErrors errors = meter_.measure(image, image.truth[k], candidate.camera_from_object);
    if (row.truth >= 0 && !(errors.mspd < row.errors.mspd)) continue;
    row.truth = int(k);
    row.errors = errors;
    row.visible = image.truth[k].visible;
  }
  if (row.truth < 0 || row.errors.mspd < kRightError) return row;

  const GroundTruth& truth = image.truth[size_t(row.truth)];
  const Rigid3& pose = candidate.camera_from_object;
  const double apart = (pose.translation - truth.camera_from_object.translation).norm();
  if (apart < kSamePlace * meter_.model(bop_object).diameter) row.adi = meter_.closestDistance(truth, pose);
  return row;
}

void CandidateDump::add(const BopImage& image, const std::vector<JudgedCandidate>& candidates,
                        const std::vector<int>& bop_objects) {
  for (size_t i = 0; i < candidates.size(); ++i) {
    Row row = measured(image, candidates[i], bop_objects.at(size_t(candidates[i].object)));
    row.index = int(i);
    rows_.push_back(std::move(row));
  }
}

void CandidateDump::write(const std::string& path) const {
  std::set<std::string> terms;
  for (const Row& row : rows_)
    for (const auto& term : row.candidate.evidence) terms.insert(term.first);

  std::ofstream file(path);
  file.precision(9);
  file << "scene_id,im_id,obj_id,name,decision,probability,plausibility,reliability,gt_id,mspd_px,mssd_d,"
          "visib,adi_d";
  for (const std::string& term : terms) file << ',' << term;
  file << ",candidate,fate,suppressed_by,conflicts,kind,rank_score,contests,r11,r12,r13,r21,r22,r23,r31,r32,"
          "r33,t1,t2,"
          "t3\n";

  for (const Row& row : rows_) {
    const JudgedCandidate& c = row.candidate;
    file << row.scene << ',' << row.image << ',' << row.bop_object << ',' << c.name << ','
         << (c.fate == Fate::kSuppressed ? std::string() : toString(c.fate)) << ',' << c.probability << ','
         << c.plausibility << ',' << c.reliability << ',';
    if (row.truth >= 0)
      file << row.truth << ',' << row.errors.mspd << ',' << row.errors.mssd << ',' << row.visible;
    else
      file << ",,,";
    file << ',';
    if (row.adi >= 0) file << row.adi;

    for (const std::string& term : terms) {
      const auto value = c.evidence.find(term);
      file << ',';
      if (value != c.evidence.end()) file << value->second;
    }
    writeFate(row.index, c, &file);
    writeContests(c.contests, &file);
    writePose(c.camera_from_object, &file);
    file << '\n';
  }
  file.close();
  if (!file) throw BadInput(path + ": cannot be written");
}

DumpedPoses::DumpedPoses(const std::string& path) {
  const CsvTable table(path);
  const int scene = table.column("scene_id"), image = table.column("im_id"), object = table.column("obj_id");
  const int first = table.column("r11"), last = table.column("t3");
  if (last - first != 11) throw BadInput(path + ": the columns r11 ... t3 are not those of a dump");

  for (size_t row = 0; row < table.rows(); ++row) {
    PoseProposal proposal;
    proposal.object = int(table.number(row, object));
    for (int k = 0; k < 9; ++k)
      proposal.camera_from_object.rotation(k / 3, k % 3) = table.number(row, first + k);
    for (int k = 0; k < 3; ++k) proposal.camera_from_object.translation[k] = table.number(row, first + 9 + k);
    poses_[{int(table.number(row, scene)), int(table.number(row, image))}].push_back(proposal);
  }
}

std::vector<PoseProposal> DumpedPoses::of(const BopImage& image, const std::vector<int>& bop_objects) const {
  std::vector<PoseProposal> proposals;
  const auto found = poses_.find({image.scene, image.id});
  if (found == poses_.end()) return proposals;

  for (PoseProposal proposal : found->second) {
    const auto object = std::find(bop_objects.begin(), bop_objects.end(), proposal.object);
    if (object == bop_objects.end()) continue;
    proposal.object = int(object - bop_objects.begin());
    proposals.push_back(proposal);
  }
  return proposals;
}

}  // namespace monocular_eye_hand
