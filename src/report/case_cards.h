#pragma once
#include <filesystem>
#include <string>

#include "html.h"
#include "monocular_eye_hand/report/evaluation_pages.h"

namespace monocular_eye_hand {

/// Writes the cards of missed and wrong objects, a picture beside the page for each.
class CaseCards {
 public:
  CaseCards(const std::filesystem::path& folder, const EvaluatedRun& run);

  /// What the colours of the pictures mean.
  static void legend(HtmlPage* page);
  void missed(const MissedObject& missed, HtmlPage* page);
  void wrong(const WrongAccept& wrong, HtmlPage* page);

  /// Share of an instance's contour inside its image; 1 when the image cannot be loaded.
  double inFrame(const TruthOutcome& truth) const;

 private:
  const ObjectModel& model(int object) const;
  const BopImage& imageOf(int scene, int image) const;
  std::string partName(int object) const;
  std::string missedText(const MissedObject& missed) const;
  std::string wrongText(const WrongAccept& wrong) const;
  // Both add what hinders the picture to the card's text.
  void addPicture(const std::string& file, const BopImage& image, const std::vector<struct Outline>& outlines,
                  HtmlPage::Card* card) const;

  std::filesystem::path folder_;
  const EvaluatedRun& run_;
  int missed_count_ = 0, wrong_count_ = 0;
};

/// "93 %".
std::string percentText(double share);

/// Creates the folder and writes the page's text into its index.html. Returns its path. Throws BadInput.
std::string writePage(const std::string& folder, const HtmlPage& page);
void createFolder(const std::string& folder);

}  // namespace monocular_eye_hand
