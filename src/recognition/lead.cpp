#include "monocular_eye_hand/recognition/lead.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <utility>

namespace monocular_eye_hand {
namespace {

constexpr double kMinLead = -2, kMaxLead = 8;  // of a lead; farther says no more [log-odds]
constexpr size_t kOthersElsewhere = 2;         // better ones elsewhere that are passed over
constexpr double kImprobable = 0;              // log-odds below which a candidate is no instance of its own

// The value that a quarter of them lies below; the values come in another order.
double lowerQuartile(std::vector<double>* values) {
  const auto quarter = values->begin() + std::ptrdiff_t(values->size() / 4);
  std::nth_element(values->begin(), quarter, values->end());
  return *quarter;
}

Lead leadOf(double own, std::vector<double> in_place, std::vector<double> elsewhere) {
  Lead lead{kMaxLead, kMaxLead, kMaxLead};
  if (!in_place.empty()) lead.in_place = leadOver(own, *std::max_element(in_place.begin(), in_place.end()));

  std::vector<double> improbable;
  for (double other : elsewhere)
    if (other < kImprobable) improbable.push_back(other);
  if (improbable.size() > kOthersElsewhere) {
    const auto third = improbable.begin() + kOthersElsewhere;
    std::nth_element(improbable.begin(), third, improbable.end(), std::greater<double>());
    lead.elsewhere = leadOver(own, *third);
  }

  std::vector<double> all = std::move(elsewhere);
  all.insert(all.end(), in_place.begin(), in_place.end());
  if (!all.empty()) lead.over_most = leadOver(own, lowerQuartile(&all));
  return lead;
}

}  // namespace

double leadOver(double own_log_odds, double other_log_odds) {
  return std::clamp(own_log_odds - other_log_odds, kMinLead, kMaxLead);
}

std::vector<Lead> leadsAmong(const std::vector<Competitor>& competitors) {
  std::map<int, std::vector<int>> of_object;
  std::set<std::pair<int, int>> conflicts;
  for (int i = 0; i < int(competitors.size()); ++i) {
    of_object[competitors[size_t(i)].object].push_back(i);
    for (int other : competitors[size_t(i)].conflicts) conflicts.insert(std::minmax(i, other));
  }

  std::vector<Lead> leads;
  for (int i = 0; i < int(competitors.size()); ++i) {
    std::vector<double> in_place, elsewhere;
    for (int other : of_object.at(competitors[size_t(i)].object)) {
      if (other == i) continue;
      std::vector<double>& side = conflicts.count(std::minmax(i, other)) ? in_place : elsewhere;
      side.push_back(competitors[size_t(other)].log_odds);
    }
    leads.push_back(leadOf(competitors[size_t(i)].log_odds, std::move(in_place), std::move(elsewhere)));
  }
  return leads;
}

}  // namespace monocular_eye_hand
