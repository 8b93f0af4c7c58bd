#include "monocular_eye_hand/options/options.h"
#include "support/refusal.h"

#include <gmock/gmock.h>

#include <clocale>
#include <cstdio>
#include <fstream>

namespace monocular_eye_hand {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

struct LensOptions {
  double blur = 0.5;
  std::array<double, 3> k{0, 0, 0};
  template <class Visitor>
  void visit(Visitor&& v) {
    v("blur", blur);
    v("k", k);
  }
  void check() const {
    if (!(blur > 0)) throw BadInput("blur = " + std::to_string(blur) + " must be positive");
  }
};

struct Stage {
  std::string name;
  int rounds = 1;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("name", name);
    v("rounds", rounds);
  }
};

struct CameraOptions {
  LensOptions lens;
  bool colour = false;
  int lines = 480;
  double gain = 1.5;
  std::string title = "left camera";
  std::vector<double> steps{1, 2.5};
  std::vector<Stage> stages;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("lens", lens);
    v("colour", colour);
    v("lines", lines);
    v("gain", gain);
    v("title", title);
    v("steps", steps);
    v("stages", stages);
  }
  void check() const {
    if (lines < 2) throw BadInput("lines = " + std::to_string(lines) + " must be at least 2");
  }
};

CameraOptions fromYaml(const std::string& yaml) {
  CameraOptions options;
  readOptions(parseYaml(yaml), &options);
  return options;
}

std::string refusalOf(const std::string& yaml) {
  return refusal([&] { fromYaml(yaml); });
}

TEST(Options, AbsentKeysKeepTheDefaults) {
  const CameraOptions options = fromYaml("");
  EXPECT_EQ(options.lines, 480);
  EXPECT_EQ(options.lens.blur, 0.5);
  EXPECT_THAT(options.steps, ElementsAre(1, 2.5));
}

TEST(Options, EveryTypeIsRead) {
  const CameraOptions options = fromYaml(R"(
lens: {blur: 2, k: [0.1, -2e-3, 3]}
colour: true
lines: 600
gain: -1e3
title: the right one
steps: []
stages:
  - {name: first}
  - {name: second, rounds: 7}
)");

  EXPECT_EQ(options.lens.blur, 2);
  EXPECT_THAT(options.lens.k, ElementsAre(0.1, -2e-3, 3));
  EXPECT_TRUE(options.colour);
  EXPECT_EQ(options.lines, 600);
  EXPECT_EQ(options.gain, -1000);
  EXPECT_EQ(options.title, "the right one");
  EXPECT_THAT(options.steps, ElementsAre());
  ASSERT_EQ(options.stages.size(), 2u);
  EXPECT_EQ(options.stages[0].rounds, 1);
  EXPECT_EQ(options.stages[1].name, "second");
  EXPECT_EQ(options.stages[1].rounds, 7);
}

struct PathOptions {
  double rotation_deviation = 0.002;
  std::string turns;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("rotation_deviation", rotation_deviation);
    v("turns", turns);
  }
};

struct PlanOptions {
  PathOptions path;
  template <class Visitor>
  void visit(Visitor&& v) {
    v("path", path);
  }
};

TEST(Options, AKeyOfAnEarlierVersionIsRefusedWithItsNewName) {
  PlanOptions options;
  EXPECT_EQ(refusal([&] { readOptions(parseYaml("path: {turn_deviation: 0.01}"), &options); }),
            "'path.turn_deviation' is now called 'path.rotation_deviation'");
  EXPECT_EQ(options.path.rotation_deviation, 0.002);

  // Where the new name means nothing the old one is a key like any other.
  EXPECT_THAT(refusal([&] { readOptions(parseYaml("turn_deviation: 1"), &options); }),
              HasSubstr("unknown key"));
  readOptions(parseYaml("path: {turns: some}"), &options);
  EXPECT_EQ(options.path.turns, "some");
}

TEST(Options, AnUnknownKeyIsNamedInFullWithTheNearestKnownOne) {
  const std::string nested = refusalOf("lens: {blurr: 1}");
  EXPECT_THAT(nested, HasSubstr("unknown key 'lens.blurr'"));
  EXPECT_THAT(nested, HasSubstr("did you mean 'lens.blur'?"));
  EXPECT_THAT(nested, HasSubstr("Known here: blur, k"));
  EXPECT_THAT(refusalOf("stages: [{}, {round: 2}]"), HasSubstr("'stages[1].round'"));
  EXPECT_THAT(refusalOf("line: 2"), HasSubstr("did you mean 'lines'?"));
  EXPECT_THAT(refusalOf("lens: {bl: 2}"), HasSubstr("did you mean 'lens.blur'?"));
  const std::string far_off = refusalOf("exposure_time: 1");
  EXPECT_THAT(far_off, HasSubstr("'exposure_time'"));
  EXPECT_THAT(far_off, Not(HasSubstr("did you mean")));
  EXPECT_THAT(far_off, HasSubstr("Known here: lens, colour, lines, gain, title, steps, stages"));
}

TEST(Options, AWrongTypeIsNamedWithKeyValueAndExpectedType) {
  EXPECT_EQ(refusalOf("lines: 4.5"), "'lines' is '4.5'; an integer is expected");
  EXPECT_EQ(refusalOf("lines: 99999999999"), "'lines' is '99999999999'; an integer is expected");
  EXPECT_EQ(refusalOf("gain: much"), "'gain' is 'much'; a finite number is expected");
  EXPECT_EQ(refusalOf("gain: 1.5 px"), "'gain' is '1.5 px'; a finite number is expected");
  EXPECT_EQ(refusalOf("gain: .nan"), "'gain' is '.nan'; a finite number is expected");
  EXPECT_EQ(refusalOf("gain: 1e999"), "'gain' is '1e999'; a finite number is expected");
  EXPECT_EQ(refusalOf("gain:"), "'gain' is nothing; a finite number is expected");
  EXPECT_EQ(refusalOf("colour: maybe"), "'colour' is 'maybe'; true or false is expected");
  EXPECT_EQ(refusalOf("title: [a, b]"), "'title' is a list of 2; a text is expected");
  EXPECT_EQ(refusalOf("steps: 3"), "'steps' is '3'; a list is expected");
  EXPECT_EQ(refusalOf("steps: [1, x]"), "'steps[1]' is 'x'; a finite number is expected");
  EXPECT_EQ(refusalOf("lens: {k: [1, 2]}"), "'lens.k' is a list of 2; a list of 3 is expected");
  EXPECT_EQ(refusalOf("lens: 5"), "'lens' is '5'; a map is expected");
  EXPECT_EQ(refusalOf("- 1"), "the options are a list of 1; a map is expected");
}

TEST(Options, CheckIsCalledForNestedStructsToo) {
  EXPECT_EQ(refusalOf("lines: 1"), "lines = 1 must be at least 2");
  EXPECT_THAT(refusalOf("lens: {blur: 0}"), StartsWith("lens: blur = 0"));
}

TEST(Options, RefusedOptionsChangeNothing) {
  CameraOptions options;
  EXPECT_THROW(readOptions(parseYaml("{lines: 100, gain: x}"), &options), BadInput);
  EXPECT_EQ(options.lines, 480);
}

TEST(Options, WhatIsWrittenReadsBackEqual) {
  CameraOptions options;
  options.gain = 0.1 + 0.2;
  options.title = "# \"quoted\"\n: true";
  options.stages = {{"true", 3}, {"", -4}};
  options.lens.k = {1e300, -1e-17, 1.0 / 3};
  const OptionTree tree = writeOptions(options);
  const OptionTree back = parseYaml(toYaml(tree));
  EXPECT_TRUE(back == tree) << toYaml(tree);
  CameraOptions again;
  readOptions(back, &again);
  EXPECT_EQ(again.gain, options.gain);
  EXPECT_EQ(again.title, options.title);
  EXPECT_EQ(again.stages[0].name, "true");
  EXPECT_EQ(again.stages[1].name, "");
  EXPECT_EQ(again.lens.k, options.lens.k);
}

TEST(Options, WrittenText) {
  CameraOptions options;
  options.stages = {{"a", 3}};
  options.gain = 1e-9;
  EXPECT_EQ(toYaml(writeOptions(options)), R"(lens:
  blur: 0.5
  k: [0.0, 0.0, 0.0]
colour: false
lines: 480
gain: 1.0e-09
title: "left camera"
steps: [1.0, 2.5]
stages:
  - name: "a"
    rounds: 3
)");
}

TEST(Options, NumbersDoNotDependOnTheLocale) {
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C"}) {
    if (!std::setlocale(LC_ALL, name)) continue;
    EXPECT_EQ(fromYaml("gain: 2.25").gain, 2.25) << name;
    EXPECT_THAT(toYaml(writeOptions(CameraOptions())), HasSubstr("gain: 1.5\n")) << name;
  }
  std::setlocale(LC_ALL, "C");
}

TEST(Yaml, BrokenInputIsRefusedWithItsSourceAndLine) {
  const auto message = [](const std::string& text) { return refusal([&] { parseYaml(text, "x.yaml"); }); };
  EXPECT_THAT(message("a: 1\nb: [1, 2"), StartsWith("x.yaml: not valid YAML: "));
  EXPECT_EQ(message("a: 1\nb: {c: 1, c: 2}"), "x.yaml: 'b.c' stands twice (line 2)");
  EXPECT_EQ(message("[1, 2]: 3"), "x.yaml: a key is not a plain name (line 1)");
  EXPECT_THAT(message("a: 1\nb: &x {c: *x}"), HasSubstr("nested more than 100 levels"));
  std::string doubled = "a0: &a0 [1, 1]\n";
  for (int k = 1; k < 30; ++k) {
    const std::string last = "*a" + std::to_string(k - 1), name = "a" + std::to_string(k);
    doubled += name + ": &" + name + " [" + last + ", " + last + "]\n";
  }
  EXPECT_THAT(message(doubled), HasSubstr("more than 1000000 values"));
}

TEST(Yaml, Files) {
  EXPECT_THROW(loadYaml("/nowhere/options.yaml"), BadInput);
  EXPECT_THROW(loadYaml(testing::TempDir()), BadInput);
  const std::string path = testing::TempDir() + "/options_test.yaml";
  std::ofstream(path) << "lines: 1\n";
  EXPECT_EQ(refusal([&] { loadOptions<CameraOptions>(path); }), path + ": lines = 1 must be at least 2");
  std::ofstream(path) << "";
  EXPECT_EQ(loadOptions<CameraOptions>(path).lines, 480);
  std::remove(path.c_str());
}

}  // namespace
}  // namespace monocular_eye_hand
