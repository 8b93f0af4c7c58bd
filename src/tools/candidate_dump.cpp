#include "candidate_dump.h"

#include <fstream>
#include <set>

#include "monocular_eye_hand/geometry/error.h"

namespace monocular_eye_hand {

void CandidateDump::add(const BopImage& image, const ObjectEstimate& candidate, int bop_object) {
  Row row;
  row.scene = image.scene, row.image = image.id, row.bop_object = bop_object;
  row.candidate = candidate;
  for (size_t k = 0; k < image.truth.size(); ++k) {
    if (image.truth[k].object != bop_object) continue;
    const PoseErrors errors = meter_.measure(image, image.truth[k], candidate.camera_from_object);
    if (row.truth >= 0 && !(errors.mspd < row.errors.mspd)) continue;
    row.truth = int(k), row.errors = errors, row.visible = image.truth[k].visible;
  }
  rows_.push_back(std::move(row));
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
  file << '\n';
  for (const Row& row : rows_) {
    const ObjectEstimate& c = row.candidate;
    file << row.scene << ',' << row.image << ',' << row.bop_object << ',' << c.name << ',' << name(c.decision)
         << ',' << c.probability << ',' << c.plausibility << ',' << c.reliability << ',';
    if (row.truth >= 0)
      file << row.truth << ',' << row.errors.mspd << ',' << row.errors.mssd << ',' << row.visible;
    else
      file << ",,,";
    for (const std::string& term : terms) {
      const auto value = c.evidence.find(term);
      file << ',';
      if (value != c.evidence.end()) file << value->second;
    }
    file << '\n';
  }
  file.close();
  if (!file) throw BadInput(path + ": cannot be written");
}

}  // namespace monocular_eye_hand
