#pragma once
#include <vector>

#include "monocular_eye_hand/recognition/decision_weights.h"
#include "recognition/candidate.h"

namespace monocular_eye_hand {

/// Log-odds that object and pose of the candidate are right, by what speaks for it alone: what the image
/// shows and what it stands on.
double ownLogOdds(const Candidate& candidate, const DecisionWeights& weights);
/// ... as a probability.
double ownProbability(const Candidate& candidate, const DecisionWeights& weights);

/// The weights for a search for so many models. An image shows few of many known parts: each of them is less
/// likely from the start than one of the five that the weights were fitted with.
DecisionWeights amongModels(DecisionWeights weights, int models);

/// Order among explanations of the same part of the image: the probability (before the winner of a contest
/// shared it) times the root of the evidence.
/// Evidence alone lets large wrong poses win, probability alone lets a tidy part of an object win over the
/// whole.
double rankScore(const Candidate& candidate);

/// Whether a chosen candidate leaves no room for another one: they share the same faces, or most of the other
/// one's edge points are the chosen one's.
bool conflict(const Candidate& chosen, const Candidate& other);

/// Of each candidate the indices of all others that, chosen, would suppress it (conflict()); ascending.
std::vector<std::vector<int>> allConflicts(const std::vector<Candidate>& candidates);

/// How a candidate stands among the others of its object (leadsAmong).
struct Standing {
  Lead lead;
  double probability = 0;
};
std::vector<Standing> standings(const std::vector<Candidate>& candidates, const DecisionWeights& weights);

/// The candidates with the probabilities of their standings, which take the place of those by their own
/// evidence alone.
std::vector<Candidate> weighAmongOthers(std::vector<Candidate> candidates, const DecisionWeights& weights);

/// A chosen candidate and the others that explain the same part of the image.
struct Explanation {
  int candidate = 0;
  std::vector<int> rivals;  ///< suppressed candidates, best first
};

/// Chooses candidates so that no two explain the same part of the image: best rank first; one whose faces
/// overlap a chosen one's, or whose edge points are mostly claimed already, becomes its rival.
std::vector<Explanation> chooseExplanations(const std::vector<Candidate>& candidates);

/// Candidates, and what is chosen of them.
struct Explained {
  std::vector<Candidate> candidates;
  std::vector<Explanation> chosen;
};
/// By chooseExplanations().
Explained explained(std::vector<Candidate> candidates);

}  // namespace monocular_eye_hand
