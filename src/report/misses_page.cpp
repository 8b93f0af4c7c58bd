#include "report/case_cards.h"

#include <fmt/format.h>

namespace monocular_eye_hand {
namespace {

void causeTable(const std::vector<CauseCount>& causes, size_t all, HtmlPage* page) {
  std::vector<HtmlPage::Row> rows;
  for (const CauseCount& cause : causes)
    rows.push_back({std::to_string(cause.count), percentText(cause.count / double(all)), cause.cause});
  if (!rows.empty()) page->table({"count", "share", "cause"}, rows);
}

}  // namespace

std::string writeMissesPage(const std::string& folder, const EvaluatedRun& run) {
  createFolder(folder);
  CaseCards cards(folder, run);
  const auto missed = missedObjects(run.split, run.models, run.outcomes, run.judged, run.traced, run.limits,
                                    [&](const TruthOutcome& truth) { return cards.inFrame(truth); });
  const auto wrong = wrongAccepts(run.split, run.models, run.outcomes, run.judged);

  HtmlPage page(run.title + ": what was missed and what is wrong");
  for (const std::string& note : run.notes) page.paragraph(note);
  page.heading("Causes", "causes");
  page.paragraph(fmt::format("{} wanted instances (at least half visible) were missed.", missed.size()));
  causeTable(causeCounts(missed), missed.size(), &page);
  page.paragraph(fmt::format("{} reported poses are wrong (10 px MSPD or more).", wrong.size()));
  causeTable(causeCounts(wrong), wrong.size(), &page);

  page.heading("Missed", "missed");
  page.legend(caseColours());
  page.beginGrid(true);
  for (const MissedObject& one : missed) page.card(cards.missed(one));
  page.endGrid();

  page.heading("Wrong", "wrong");
  page.beginGrid(true);
  for (const WrongAccept& one : wrong) page.card(cards.wrong(one));
  page.endGrid();
  return writePage(folder, page);
}

}  // namespace monocular_eye_hand
