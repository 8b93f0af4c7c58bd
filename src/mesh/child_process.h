#pragma once
#include <string>
#include <vector>

namespace monocular_eye_hand {

/// How a program ended, and what it wrote to its standard output.
struct ChildResult {
  int status = 0;  ///< as waitpid() tells it
  std::string output;
};

/// Runs a program to its end with `input` as its standard input, which is a file. May be called by any thread
/// of a process that has many. Throws std::system_error when the program cannot be started.
ChildResult runChild(const std::string& program, const std::vector<std::string>& arguments,
                     const std::string& input);

/// The file of the library or program that holds this address.
std::string fileOf(const void* address);

}  // namespace monocular_eye_hand
