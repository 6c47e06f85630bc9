#include "cli/ball/served_judge.h"

#include <fmt/format.h>
#include <optional>
#include <utility>

namespace orb::cli {

/// Listens to one ball.
class ServedJudge::Seat final : public serve::Witness {
public:
  Seat(const ServedJudge& all, int index)
      : name_(all.count_ == 1 ? "" : fmt::format("ball {}, ", index + 1)), robot_(all.robot_) {}

  void on_client(Instant) override {
    // The first client finds the robot asleep; later ones find what the earlier ones left.
    const auto awake =
        judged.empty() ? protocol::ClientJudge::Awake::No : protocol::ClientJudge::Awake::Perhaps;
    protocol::Conversation about;
    about.kind = robot_;
    about.has_start = true;
    judge_.emplace(about, spec::info(robot_).packets, awake);
  }
  void on_bytes(Instant at, protocol::Direction direction, ByteView bytes) override {
    if (!judge_)
      return;
    protocol::LogLine line;
    line.at = at.time_since_epoch();
    line.when = fmt::format("{:.3f}", std::chrono::duration<double>(*line.at).count());
    line.direction = direction;
    line.bytes.assign(bytes.begin(), bytes.end());
    line.greets = spec::is_greeting(as_text(bytes));
    judge_->take(line);
  }
  void on_parting(Instant) override { end(protocol::Ending::Over); }

  void end(protocol::Ending ending) {
    if (judge_)
      judged.push_back({fmt::format("{}session {}", name_, judged.size() + 1),
                        spec::info(robot_).packets, judge_->end(ending)});
    judge_.reset();
  }

  std::vector<Judged> judged;

private:
  std::string name_;
  spec::Robot robot_;
  std::optional<protocol::ClientJudge> judge_;
};

ServedJudge::ServedJudge(int count, spec::Robot robot) : count_(count), robot_(robot) {}
ServedJudge::~ServedJudge() = default;

serve::Witness* ServedJudge::hear(int index) {
  return seats_.emplace_back(std::make_unique<Seat>(*this, index)).get();
}

JudgedLog ServedJudge::finish() {
  JudgedLog log{"orb ball", Numbered::Nothing, {}};
  for (const auto& seat : seats_) {
    seat->end(protocol::Ending::Unseen);
    for (auto& one : seat->judged)
      log.conversations.push_back(std::move(one));
  }
  return log;
}

} // namespace orb::cli
