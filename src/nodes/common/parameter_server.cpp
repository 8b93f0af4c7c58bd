#include "nodes/common/parameter_server.h"

#include <ros/param.h>
#include <ros/this_node.h>

#include <algorithm>

namespace monocular_eye_hand {

OptionTree toOptionTree(XmlRpc::XmlRpcValue value) {
  using Value = XmlRpc::XmlRpcValue;
  switch (value.getType()) {
    case Value::TypeInvalid:
      return {};
    case Value::TypeBoolean:
      return options_detail::write(bool(value));
    case Value::TypeInt:
      return options_detail::write(int(value));
    case Value::TypeDouble:
      return options_detail::write(double(value));
    case Value::TypeString:
      return options_detail::write(std::string(value));
    case Value::TypeArray: {
      OptionTree tree = OptionTree::ofList();
      for (int i = 0; i < value.size(); ++i) tree.list.push_back(toOptionTree(value[i]));
      return tree;
    }
    case Value::TypeStruct: {
      OptionTree tree = OptionTree::ofMap();
      for (auto& entry : value) tree.set(entry.first, toOptionTree(entry.second));
      return tree;
    }
    default:
      throw BadInput("a parameter is a date or binary data, which no option is");
  }
}

OptionTree privateParameters(const std::vector<std::string>& foreign) {
  XmlRpc::XmlRpcValue value;
  if (!ros::param::get(ros::this_node::getName(), value)) return OptionTree::ofMap();
  OptionTree tree = toOptionTree(value);
  auto& map = tree.map;
  map.erase(std::remove_if(map.begin(), map.end(),
                           [&](const auto& entry) {
                             return std::find(foreign.begin(), foreign.end(), entry.first) != foreign.end();
                           }),
            map.end());
  return tree;
}

}  // namespace monocular_eye_hand
