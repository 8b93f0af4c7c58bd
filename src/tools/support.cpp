#include "tools/support.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "monocular_eye_hand/geometry/error.h"
#include "monocular_eye_hand/options/options.h"

namespace monocular_eye_hand {

bool parseArguments(CLI::App* app, int argc, char** argv, int* exit_code, int mistake) {
  try {
    app->parse(argc, argv);
    return true;
  } catch (const CLI::ParseError& e) {
    *exit_code = app->exit(e) == 0 ? 0 : mistake;
    return false;
  }
}

void refuseRenamed(CLI::App* app, const std::string& old_name, const std::string& new_name) {
  app->add_option_function<std::string>(old_name,
                                        [old_name, new_name](const std::string&) {
                                          throw CLI::ValidationError(old_name,
                                                                     "it is called " + new_name + " now");
                                        })
      ->group("");  // not in --help
}

int runTool(const std::string& name, const std::function<int()>& body, int failure) {
  try {
    return body();
  } catch (const std::exception& e) {
    std::cout.flush();
    std::cerr << name << ": " << e.what() << "\n";
    return failure;
  }
}

void writeText(const std::string& path, const std::string& text) {
  if (path == "-") {
    std::cout << text << std::flush;
    return;
  }
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::error_code ignored;  // the file tells
  if (!folder.empty()) std::filesystem::create_directories(folder, ignored);

  std::ofstream file(path);
  file << text;
  file.close();
  if (!file) throw BadInput(path + ": cannot be written");
}

RecognitionOptions recognitionOptions(const std::string& yaml_path, const std::vector<std::string>& settings,
                                      const std::string& decision_path) {
  RecognitionOptions options;
  if (!decision_path.empty()) options.decision = loadOptions<DecisionWeights>(decision_path);
  if (!yaml_path.empty()) {
    const OptionTree tree = loadYaml(yaml_path);
    const OptionTree* of_node = tree.find("recognition");
    try {
      readOptions(of_node ? *of_node : tree, &options);
    } catch (const BadInput& e) {
      throw BadInput(yaml_path + ": " + e.what());
    }
  }

  for (const std::string& setting : settings) {
    const size_t equals = setting.find('=');
    if (equals == 0 || equals == std::string::npos)
      throw BadInput("--set " + setting + ": of the form key=value or group.key=value");

    OptionTree tree = parseYaml(setting.substr(equals + 1), "--set " + setting);
    for (std::string key = setting.substr(0, equals); !key.empty();) {
      const size_t dot = key.rfind('.');
      OptionTree outer = OptionTree::ofMap();
      outer.set(dot == std::string::npos ? key : key.substr(dot + 1), std::move(tree));
      tree = std::move(outer);
      key = dot == std::string::npos ? "" : key.substr(0, dot);
    }

    try {
      readOptions(tree, &options);
    } catch (const BadInput& e) {
      throw BadInput("--set " + setting + ": " + e.what());
    }
  }
  return options;
}

Progress::Progress(size_t total, bool shown)
    : total_(total), shown_(shown), terminal_(isatty(STDERR_FILENO)) {}

Progress::~Progress() { endLine(); }

void Progress::endLine() {
  if (open_) std::fputc('\n', stderr);
  open_ = false;
}

void Progress::step(const std::string& text) {
  ++done_;
  if (!shown_) return;
  if (terminal_) {
    std::fprintf(stderr, "\r\033[K[%zu/%zu] %s", done_, total_, text.c_str());
    open_ = true;
    if (done_ == total_) endLine();
  } else if (done_ % std::max<size_t>(1, total_ / 20) == 0 || done_ == total_) {
    std::fprintf(stderr, "[%zu/%zu] %s\n", done_, total_, text.c_str());
  }
  std::fflush(stderr);
}

}  // namespace monocular_eye_hand
