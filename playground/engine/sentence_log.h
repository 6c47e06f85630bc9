#pragma once

#include "base/render.h"

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace orb::playground {

/// The messages of an answer. They are in English; the page translates them.
class SentenceLog {
public:
  /// Says messages in English and records them; valid as long as this object.
  Say say();
  /// `{"SENTENCE": ["TEXT", FILLER…]}`, where a filler is such a list or plain words. Clears the
  /// record.
  nlohmann::ordered_json take();

private:
  std::map<std::string, Message> messages_;
};

} // namespace orb::playground
