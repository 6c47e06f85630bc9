#pragma once

#include "base/render.h"

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace orb::playground {

/// The messages of an answer: the page, which is told them in English, says them in its language.
class Said {
public:
  /// Says messages in English, and keeps them; good as long as this.
  Say say();
  /// `{"SENTENCE": ["TEXT", FILLER…]}`, where a filler is such a list, or words as they are;
  /// nothing is kept then.
  nlohmann::ordered_json take();

private:
  std::map<std::string, Message> messages_;
};

} // namespace orb::playground
