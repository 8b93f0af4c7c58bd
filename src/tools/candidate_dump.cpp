#include "candidate_dump.h"

#include <fstream>
#include <ostream>
#include <set>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {

namespace {

void writePose(const Rigid3& pose, std::ostream* out) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) *out << ',' << pose.rotation(row, column);
  for (int i = 0; i < 3; ++i) *out << ',' << pose.translation[i];
}

void writeFate(int index, const JudgedCandidate& candidate, std::ostream* out) {
  *out << ',' << index << ',' << name(candidate.fate) << ',';
  if (candidate.fate == Fate::kSuppressed) *out << candidate.suppressed_by;

  *out << ',';
  const char* separator = "";
  for (int conflict : candidate.conflicts) {
    *out << separator << conflict;
    separator = " ";
  }
  *out << ',' << candidate.kind << ',' << candidate.rank_score;
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
          "visib";
  for (const std::string& term : terms) file << ',' << term;
  file << ",candidate,fate,suppressed_by,conflicts,kind,rank_score,r11,r12,r13,r21,r22,r23,r31,r32,r33,t1,t2,"
          "t3\n";

  for (const Row& row : rows_) {
    const JudgedCandidate& c = row.candidate;
    file << row.scene << ',' << row.image << ',' << row.bop_object << ',' << c.name << ','
         << (c.fate == Fate::kSuppressed ? "" : name(c.fate)) << ',' << c.probability << ',' << c.plausibility
         << ',' << c.reliability << ',';
    if (row.truth >= 0)
      file << row.truth << ',' << row.errors.mspd << ',' << row.errors.mssd << ',' << row.visible;
    else
      file << ",,,";

    for (const std::string& term : terms) {
      const auto value = c.evidence.find(term);
      file << ',';
      if (value != c.evidence.end()) file << value->second;
    }
    writeFate(row.index, c, &file);
    writePose(c.camera_from_object, &file);
    file << '\n';
  }
  file.close();
  if (!file) throw BadInput(path + ": cannot be written");
}

}  // namespace monocular_eye_hand
