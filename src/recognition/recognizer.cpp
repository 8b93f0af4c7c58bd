#include "monocular_eye_hand/recognition/recognizer.h"

#include "monocular_eye_hand/geometry/error.h"
#include "recognition/image_search.h"

namespace monocular_eye_hand {

struct Recognizer::Impl {
  ModelBase base;
  RecognitionOptions options;
  std::vector<SearchModel> models;
};

Recognizer::Recognizer(ModelBase models, RecognitionOptions options) : impl_(new Impl) {
  options.check();
  if (models.objects.empty()) throw BadInput("the model base is empty: name at least one object");
  impl_->base = std::move(models);
  impl_->options = options;
  for (const KnownObject& object : impl_->base.objects) impl_->models.emplace_back(object);
}

Recognizer::~Recognizer() = default;
const ModelBase& Recognizer::models() const { return impl_->base; }
const RecognitionOptions& Recognizer::options() const { return impl_->options; }

RecognitionResult Recognizer::recognize(const cv::Mat& grey, const Camera& camera,
                                        const RecognitionRequest& request) const {
  camera.check();
  int only = -1;
  if (!request.only.empty()) {
    only = impl_->base.indexOf(request.only);
    if (only < 0) throw BadInput("unknown object '" + request.only + "'; known: " + impl_->base.names());
  }
  return ImageSearch(impl_->base, impl_->models, impl_->options, grey, camera, only).run(request.previous);
}

}  // namespace monocular_eye_hand
