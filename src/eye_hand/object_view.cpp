#include "monocular_eye_hand/eye_hand/object_view.h"

namespace monocular_eye_hand {

std::string toString(ViewOutcome outcome) {
  switch (outcome) {
    case ViewOutcome::kNew:
      return "new";
    case ViewOutcome::kMerged:
      return "merged";
    case ViewOutcome::kSeenAgain:
      return "seen again";
    case ViewOutcome::kRestarted:
      return "restarted";
    case ViewOutcome::kOutlier:
      return "outlier";
    case ViewOutcome::kDoubtful:
      return "doubtful";
    case ViewOutcome::kRefused:
      return "refused";
  }
  return "unknown";
}

std::string textOf(const ViewReport& report, const ModelBase& models) {
  std::string text;
  const auto begin = [&text](const std::string& name) { text += (text.empty() ? "" : "; ") + name; };

  for (const ViewDecision& decision : report.decisions) {
    begin(models.objects.at(size_t(decision.object)).model.name);
    if (decision.number >= 0) text += " " + std::to_string(decision.number);
    text += " " + toString(decision.outcome) + ": " + decision.reason;
  }

  for (const MappedObject& gone : report.forgotten) {
    begin(gone.name);
    text += " " + std::to_string(gone.number) + " forgotten: it was not where it should have been seen";
  }
  return text.empty() ? "nothing seen" : text;
}

}  // namespace monocular_eye_hand
