#pragma once
#include <functional>
#include <string>
#include <vector>

#include "monocular_eye_hand/recognition/options.h"

namespace CLI {  // NOLINT(readability-identifier-naming): of the library
class App;
}

namespace monocular_eye_hand {

/// Parses the command line. True when the tool is to run; else *exit_code is what main returns: 0 after
/// --help, `mistake` after a mistake, which has been told.
bool parseArguments(CLI::App* app, int argc, char** argv, int* exit_code, int mistake = 1);

/// An option that has another name now is refused with that name.
void refuseRenamed(CLI::App* app, const std::string& old_name, const std::string& new_name);

/// Runs a tool's body: what it returns; bad input is told on stderr ("name: message") and gives `failure`.
int runTool(const std::string& name, const std::function<int()>& body, int failure = 1);

/// Writes a text, into a new folder if need be; "-" is standard output. Throws BadInput naming the path when
/// it cannot.
void writeText(const std::string& path, const std::string& text);

/// The defaults, then the file ("" = none), then `settings` of the form a.b=value. A file that has the key
/// `recognition` (the node's parameters, config/recognizer.yaml) gives what stands there. `decision_path`:
/// weights of the decision as fit_decision writes them ("" = none). Throws BadInput.
RecognitionOptions recognitionOptions(const std::string& yaml_path, const std::vector<std::string>& settings,
                                      const std::string& decision_path = "");

/// A counter on stderr: one line that is rewritten on a terminal, else a line now and then.
class Progress {
 public:
  Progress(size_t total, bool shown = true);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// One more is done.
  void step(const std::string& text);

 private:
  void endLine();
  size_t total_, done_ = 0;
  bool shown_, terminal_, open_ = false;
};

}  // namespace monocular_eye_hand
