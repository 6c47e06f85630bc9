#include "playground/engine/sentence_log.h"

#include <utility>

namespace orb::playground {
namespace {

nlohmann::ordered_json parts_of(const Message& message) {
  if (message.text() == nullptr)
    return message.words();
  auto parts = nlohmann::ordered_json::array({message.text()->english});
  for (const auto& filler : message.fillers())
    parts.push_back(parts_of(filler));
  return parts;
}

} // namespace

Say SentenceLog::say() {
  return [this](const Message& message) {
    auto sentence = in_english(message);
    if (message.text() != nullptr)
      messages_[sentence] = message;
    return sentence;
  };
}

nlohmann::ordered_json SentenceLog::take() {
  auto all = nlohmann::ordered_json::object();
  for (const auto& [sentence, message] : std::exchange(messages_, {}))
    all[sentence] = parts_of(message);
  return all;
}

} // namespace orb::playground
