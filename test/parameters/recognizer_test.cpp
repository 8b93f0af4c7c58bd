#include <gtest/gtest.h>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/options/options.h"
#include "monocular_eye_hand/parameters/recognizer.h"

namespace monocular_eye_hand {
namespace {

const std::string kRecognizerConfig = std::string(MONOCULAR_EYE_HAND_SOURCE_DIR) + "/config/recognizer.yaml";

// Every entry of `part` with the same text, or the same number, in `whole`.
void expectContains(const OptionTree& whole, const OptionTree& part, const std::string& where) {
  if (part.kind != OptionTree::Kind::kMap) {
    EXPECT_EQ(part.scalar, whole.scalar) << where;
    return;
  }
  for (const auto& entry : part.map) {
    const OptionTree* value = whole.find(entry.first);
    ASSERT_NE(value, nullptr) << where << entry.first;
    expectContains(*value, entry.second, where + entry.first + ".");
  }
}

// Defaults stand in the structs; the shipped file repeats them for people and must not drift.
TEST(RecognizerParameters, ShippedFileHoldsTheDefaults) {
  const OptionTree file = loadYaml(kRecognizerConfig);
  RecognizerParameters parameters;
  parameters.objects = "some.yaml";
  readOptions(file, &parameters);
  RecognizerParameters defaults;
  defaults.objects = "some.yaml";
  EXPECT_EQ(writeOptions(parameters), writeOptions(defaults));
  expectContains(writeOptions(defaults), file, "");
}

TEST(RecognizerParameters, ShippedFileNamesEveryParameterOfTheNode) {
  const OptionTree file = loadYaml(kRecognizerConfig);
  for (const auto& entry : writeOptions(RecognizerParameters()).map) {
    if (entry.first == "objects") continue;  // the launch file's argument; it has no default
    EXPECT_NE(file.find(entry.first), nullptr) << entry.first;
  }
}

TEST(RecognizerParameters, AreChecked) {
  const auto refused = [](auto change) {
    RecognizerParameters parameters;
    parameters.objects = "some.yaml";
    EXPECT_NO_THROW(parameters.check());
    change(&parameters);
    EXPECT_THROW(parameters.check(), BadInput);
  };
  refused([](RecognizerParameters* p) { p->objects.clear(); });
  refused([](RecognizerParameters* p) { p->on_request = true; });  // continuous, too
  refused([](RecognizerParameters* p) { p->service_timeout = 0; });
  refused([](RecognizerParameters* p) { p->diagnostic_period = -1; });
  refused([](RecognizerParameters* p) { p->marker_triangles = -1; });
  refused([](RecognizerParameters* p) { p->label_height = 0; });
  refused([](RecognizerParameters* p) { p->marker_lifetime = -1; });
  refused([](RecognizerParameters* p) { p->doubtful = 1.1; });
  refused([](RecognizerParameters* p) { p->support.tolerance = -0.001; });
  refused([](RecognizerParameters* p) { p->support.wait = -1; });
  refused([](RecognizerParameters* p) { p->image_transport.clear(); });
}

}  // namespace
}  // namespace monocular_eye_hand
