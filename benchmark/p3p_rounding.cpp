// p3p_rounding OUT.csv   error of the pose from three exact points against their distance, by the paper's
// plain quartic, by the same with polished roots, and by the package's solver.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>

#include "monocular_eye_hand/pose/p3p.h"
#include "paper_p3p.h"

namespace {

using namespace monocular_eye_hand;

constexpr int kProblems = 4000;
constexpr double kLost = 1e-3;
constexpr double kNone = 1;  // error of a problem without a solution

struct Solver {
  const char* name;
  std::function<std::vector<Rigid3>(const P3PProblem&)> solve;
};

const std::vector<Solver>& solvers() {
  static const std::vector<Solver> all = {
      {"paper's quartic", [](const P3PProblem& p) { return paperP3P(p, false); }},
      {"polished quartic", [](const P3PProblem& p) { return paperP3P(p, true); }},
      {"solveP3P",
       [](const P3PProblem& p) {
         const PoseSolutions s = solveP3P(p.bearings, p.points);
         return std::vector<Rigid3>(s.camera_from_object.begin(), s.camera_from_object.begin() + s.count);
       }},
  };
  return all;
}

void measure(double distance, std::ostream& out) {
  P3PSet set = p3pSet("far10");
  set.parameter = distance;
  const std::vector<P3PProblem> problems = drawProblems(set, kProblems);
  for (const Solver& solver : solvers()) {
    std::vector<double> errors;
    for (const P3PProblem& p : problems) {
      double best = kNone;
      for (const Rigid3& pose : solver.solve(p)) best = std::min(best, poseError(pose, p.truth));
      errors.push_back(best);
    }
    std::sort(errors.begin(), errors.end());
    const auto lost = errors.end() - std::upper_bound(errors.begin(), errors.end(), kLost);
    out << solver.name << ',' << distance << ',' << errors[kProblems / 2] << ','
        << errors[kProblems * 99 / 100] << ',' << double(lost) / kProblems << '\n';
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "p3p_rounding OUT.csv\n");
    return 2;
  }
  std::ofstream out(argv[1]);
  out << "solver,distance,median,p99,lost\n";
  for (const double distance : {1.5, 3., 10., 30., 100., 300., 1000., 3000., 10000.}) measure(distance, out);
  return out.flush() ? 0 : 1;
}
