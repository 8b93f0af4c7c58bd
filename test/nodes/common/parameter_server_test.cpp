#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "monocular_eye_hand/options/options.h"
#include "nodes/common/parameter_server.h"
#include "nodes/image_source/parameters.h"

namespace monocular_eye_hand {
namespace {

using testing::HasSubstr;

template <class T>
std::string refusal(const XmlRpc::XmlRpcValue& value) {
  try {
    T options;
    readOptions(toOptionTree(value), &options);
  } catch (const BadInput& e) {
    return e.what();
  }
  return "accepted";
}

TEST(ParameterServer, EveryTypeArrives) {
  XmlRpc::XmlRpcValue value;
  value["source"] = std::string("10");  // a text that looks like a number
  value["rate"] = 12;                   // an integer where a double is wanted
  value["loop"] = false;
  value["frame_id"] = std::string("true");
  ImageSourceParameters parameters;
  readOptions(toOptionTree(value), &parameters);
  EXPECT_EQ(parameters.source, "10");
  EXPECT_EQ(parameters.rate, 12.0);
  EXPECT_FALSE(parameters.loop);
  EXPECT_EQ(parameters.frame_id, "true");
  value["rate"] = 0.1;
  readOptions(toOptionTree(value), &parameters);
  EXPECT_EQ(parameters.rate, 0.1);
}

TEST(ParameterServer, ListsAndMapsKeepTheirShape) {
  XmlRpc::XmlRpcValue value;
  value["list"][0] = 1;
  value["list"][1] = 2.5;
  value["map"]["key"] = std::string("text");
  EXPECT_EQ(toOptionTree(value), parseYaml("{list: [1, 2.5], map: {key: \"text\"}}"));
}

TEST(ParameterServer, RefusesByName) {
  XmlRpc::XmlRpcValue value;
  value["source"] = std::string("x");
  value["sorce"] = std::string("y");
  EXPECT_THAT(refusal<ImageSourceParameters>(value),
              HasSubstr("unknown key 'sorce'; did you mean 'source'?"));
  XmlRpc::XmlRpcValue wrong;
  wrong["source"] = std::string("x");
  wrong["rate"] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal<ImageSourceParameters>(wrong),
              HasSubstr("'rate' is 'nan'; a finite number is expected"));
  wrong["rate"] = -1.0;
  EXPECT_THAT(refusal<ImageSourceParameters>(wrong), HasSubstr("rate = -1"));
  XmlRpc::XmlRpcValue none;
  none["rate"] = 1.0;
  EXPECT_THAT(refusal<ImageSourceParameters>(none), HasSubstr("source is not set"));
}

}  // namespace
}  // namespace monocular_eye_hand
