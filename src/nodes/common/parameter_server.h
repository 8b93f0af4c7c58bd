#pragma once
#include <XmlRpcValue.h>

#include <string>
#include <vector>

#include "monocular_eye_hand/options/options.h"

namespace monocular_eye_hand {

/// What the parameter server holds below a name. Throws BadInput on a value that YAML cannot say.
OptionTree toOptionTree(XmlRpc::XmlRpcValue value);

/// The node's private parameters as a tree; `foreign` are keys that libraries keep there (a plugin's settings
/// below an image topic) and that are left out.
OptionTree privateParameters(const std::vector<std::string>& foreign);

}  // namespace monocular_eye_hand
