#include "serve/packet_spacer.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace orb::serve {
namespace {

/// Several clients parse only one packet per read, so a message keeps this distance from the
/// message before …
constexpr Duration message_gap = std::chrono::milliseconds{2};
/// … and a larger one from an answer, which a client may take time to process …
constexpr Duration answer_gap = std::chrono::milliseconds{8};
/// … but waits no longer than this.
constexpr Duration message_patience = std::chrono::milliseconds{20};
/// Answers are written separately, unless a pipelining client is owed more than this at once.
constexpr std::size_t answers_apart = 16;

} // namespace

void PacketSpacer::release_answers() {
  auto answers = std::exchange(answers_, {});
  if (answers.size() > answers_apart) {
    auto& all = answers.front();
    for (std::size_t i = 1; i < answers.size(); ++i)
      all.insert(all.end(), answers[i].begin(), answers[i].end());
    answers.resize(1);
  }
  std::move(answers.begin(), answers.end(), std::back_inserter(ready_));
}

void PacketSpacer::hurry() {
  release_answers();
  for (auto& message : messages_)
    ready_.push_back(std::move(message.bytes));
  messages_.clear();
}

std::vector<Bytes> PacketSpacer::take(Instant now) {
  if (!answers_.empty()) {
    release_answers();
    message_at_ = now + answer_gap;
  }
  while (!messages_.empty() && now >= next_due()) {
    ready_.push_back(std::move(messages_.front().bytes));
    messages_.pop_front();
    message_at_ = now + message_gap;
  }
  return std::exchange(ready_, {});
}

Instant PacketSpacer::next_due() const {
  return messages_.empty() ? never
                           : std::min(message_at_, messages_.front().since + message_patience);
}

void PacketSpacer::clear() {
  ready_.clear();
  answers_.clear();
  messages_.clear();
}

} // namespace orb::serve
