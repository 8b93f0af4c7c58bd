#pragma once
#include <filesystem>
#include <string>

#include "monocular_eye_hand/report/evaluation_pages.h"
#include "report/case_picture.h"
#include "report/html.h"

namespace monocular_eye_hand {

/// Makes the cards of missed and wrong objects, and writes a picture beside the page for each.
class CaseCards {
 public:
  CaseCards(const std::filesystem::path& folder, const EvaluatedRun& run);

  HtmlPage::Card missed(const MissedObject& missed);
  HtmlPage::Card wrong(const WrongAccept& wrong);

  /// Share of an instance's contour inside its image; 1 when the image cannot be loaded.
  double inFrame(const TruthOutcome& truth) const;

 private:
  const ObjectModel& model(int object) const;
  const BopImage& imageOf(int scene, int image) const;
  std::string partName(int object) const;
  std::string missedText(const MissedObject& missed) const;
  std::string wrongText(const WrongAccept& wrong) const;
  // The card with its picture, or with what hinders it.
  HtmlPage::Card pictured(HtmlPage::Card card, const std::string& file, const BopImage& image,
                          const std::vector<Outline>& outlines) const;

  std::filesystem::path folder_;
  const EvaluatedRun& run_;
  int missed_count_ = 0, wrong_count_ = 0;
};

/// What the colours of the pictures mean, for HtmlPage::legend().
std::vector<std::pair<std::string, std::string>> caseColours();
/// "93 %".
std::string percentText(double share);

/// Creates the folder and writes the page's text into its index.html. Returns its path. Throws BadInput.
std::string writePage(const std::string& folder, const HtmlPage& page);
void createFolder(const std::string& folder);

}  // namespace monocular_eye_hand
