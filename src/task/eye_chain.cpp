#include "monocular_eye_hand/task/eye_chain.h"

#include <fmt/format.h>

namespace monocular_eye_hand {
namespace {

constexpr double kOneClock = 86400.0;  // stamps of one clock do not lie further apart [s]

std::string silentPart(const EyeChain& chain, double after) {
  if (!chain.tells_recognized)
    return fmt::format("nobody publishes {}: is the node recognizer running?", chain.recognized);
  if (chain.last_recognized == 0)
    return fmt::format("{} is silent: does the camera send images to the recognizer?", chain.recognized);
  if (chain.last_recognized < after) {
    const bool other_clock = after - chain.last_recognized > kOneClock;
    return fmt::format(
        "{} last answered for an image of {:.2f} s, the camera stands still since {:.2f} s: {}",
        chain.recognized, chain.last_recognized, after,
        other_clock ? "do the nodes share one clock? use_sim_time must be set before they start"
                    : "does the camera send images to the recognizer?");
  }
  if (!chain.tells_located)
    return fmt::format("nobody publishes {}: is the node eye_hand running?", chain.located);
  return fmt::format("{} is silent, though the recognizer is not: look at the node eye_hand", chain.located);
}

}  // namespace

std::string missingInput(const EyeChain& chain, double after, double timeout) {
  if (chain.recognizer_gone)
    return fmt::format("the node recognizer does not run (any more): its service {} is not there",
                       chain.recognizer_call);
  const std::string complaint = chain.complaint.empty() ? "" : "; the recognizer says: " + chain.complaint;
  return fmt::format("no view within look_timeout = {:g} s; {}{}", timeout, silentPart(chain, after),
                     complaint);
}

}  // namespace monocular_eye_hand
