#include "protocol/judge/judge.h"

#include "protocol/judge/rules.h"
#include "protocol/log_text.h"
#include "protocol/payload.h"
#include "protocol/payload_v2.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace orb::protocol {
namespace {

using spec::ApiCommand;
using spec::Packets;
using spec::V2Command;

/// A complete log, as its client kept it.
Conversation conversation(std::string_view text) {
  Conversation all;
  all.lines = read_log(text).lines;
  all.has_start = all.has_end = true;
  return all;
}

std::string ids(const Judgement& judgement) {
  std::string out;
  for (const auto& mistake : judgement.mistakes)
    out += (out.empty() ? "" : " ") + std::string(mistake.rule->id);
  return out;
}

Packets packets_of(std::string_view log) {
  return log.find("8D") == std::string_view::npos ? Packets::V1 : Packets::V2;
}

std::string judged(std::string_view log) {
  return ids(judge(conversation(log), packets_of(log)));
}

TEST(ClientJudge, EveryRuleHasAnExampleThatRaisesItAndOneThatDoesNot) {
  for (const auto& rule : rules::all()) {
    if (rule.bad.empty())
      continue;
    EXPECT_EQ(judged(rule.bad), rule.id) << rule.bad;
    EXPECT_EQ(judged(rule.good), "") << rule.id;
  }
}

/// Builds a log of packets with times.
class Log {
public:
  Log& v1(int ms, ApiCommand command, Bytes data, std::uint8_t seq) {
    return say(ms, '>', encode(make_command(command, std::move(data), seq)));
  }
  Log& v1_ok(int ms, std::uint8_t seq) { return say(ms, '<', encode(Response{0, seq, {}})); }
  Log& v2(int ms, V2Command command, Bytes data, std::uint8_t seq,
          spec::V2Flag flag = spec::V2Flag::RequestResponse) {
    return say(
        ms, '>',
        encode(make_request(command, std::move(data), seq, static_cast<std::uint8_t>(flag))));
  }
  Log& v2_answer(int ms, V2Command command, std::uint8_t seq, std::uint8_t error = 0) {
    auto packet = make_request(command, {}, seq, static_cast<std::uint8_t>(spec::V2Flag::Response));
    packet.error = error;
    return say(ms, '<', encode(packet));
  }
  std::string text;

private:
  Log& say(int ms, char sign, const Bytes& bytes) {
    text += fmt::format("{}.{:03} {} {}\n", ms / 1000, ms % 1000, sign, to_hex(bytes));
    return *this;
  }
};

TEST(ClientJudge, FollowsNewerRobotsToTheirOwnStop) {
  Log log;
  log.v2(0, V2Command::Wake, {}, 0).v2_answer(20, V2Command::Wake, 0);
  log.v2(100, V2Command::DriveWithHeading, {60, 0, 0, 0}, 1);
  log.v2_answer(120, V2Command::DriveWithHeading, 1);
  EXPECT_EQ(judged(log.text), "left-driving");
  log.v2(2200, V2Command::Ping, {}, 2).v2_answer(2220, V2Command::Ping, 2);
  EXPECT_EQ(judged(log.text), "");
}

TEST(ClientJudge, TakesAStopThatIsRepeatedUntilItIsAnswered) {
  Log log;
  log.v1(0, ApiCommand::Roll, {60, 0, 0, 1}, 1).v1_ok(20, 1);
  log.v1(500, ApiCommand::Roll, {0, 0, 0, 0}, 2);
  EXPECT_EQ(judged(log.text), "stop-unsure");
  log.v1(1500, ApiCommand::Roll, {0, 0, 0, 0}, 3).v1_ok(1520, 3);
  EXPECT_EQ(judged(log.text), ""); // the lost one was repeated
}

TEST(ClientJudge, LeavesABallToItsOwnTimeOut) {
  Log log;
  log.v1(0, ApiCommand::SetTemporaryOptionFlags, {0, 0, 0, 1}, 0).v1_ok(20, 0);
  log.v1(100, ApiCommand::Roll, {60, 0, 0, 1}, 1).v1_ok(120, 1);
  EXPECT_EQ(judged(log.text), "");
}

TEST(ClientJudge, TakesAnOldSequenceNumberAgain) {
  Log log;
  log.v1(0, ApiCommand::Ping, {}, 0);
  log.v1(100, ApiCommand::Ping, {}, 1).v1_ok(120, 1);
  log.v1(2500, ApiCommand::Ping, {}, 0).v1_ok(2520, 0);
  EXPECT_EQ(judged(log.text), "answer-unmatched");
  Log same; // the same number for every command, each answered in time
  same.v1(0, ApiCommand::Ping, {}, 0).v1_ok(20, 0);
  same.v1(100, ApiCommand::Ping, {}, 0).v1_ok(120, 0);
  EXPECT_EQ(judged(same.text), "");
}

TEST(ClientJudge, MayNotKnowTheBeginningAndTheEnd) {
  Log log;
  log.v2(100, V2Command::DriveWithHeading, {60, 0, 0, 0}, 1);
  log.v2_answer(120, V2Command::DriveWithHeading, 1);
  log.v2_answer(130, V2Command::Ping, 9);
  auto whole = conversation(log.text);
  EXPECT_EQ(ids(judge(whole, Packets::V2)), "not-awake answer-unmatched left-driving");
  whole.has_start = false;
  EXPECT_EQ(ids(judge(whole, Packets::V2)), "left-driving");
  whole.has_end = false;
  EXPECT_EQ(ids(judge(whole, Packets::V2)), "");
}

TEST(ClientJudge, KnowsRobots) {
  Log log;
  log.v2(0, V2Command::Wake, {}, 0).v2_answer(90, V2Command::Wake, 0);
  log.v2(100, V2Command::MatrixColor, {1, 2, 3}, 1, spec::V2Flag::Unused);
  log.v2(200, V2Command::Ping, {}, 2).v2_answer(210, V2Command::Ping, 2);
  auto all = conversation(log.text);
  EXPECT_EQ(ids(judge(all, Packets::V2)), "");
  all.kind = spec::Robot::Bolt;
  EXPECT_EQ(ids(judge(all, Packets::V2)), "");
  all.kind = spec::Robot::Mini; // has no matrix, and takes a command every 120 ms
  EXPECT_EQ(ids(judge(all, Packets::V2)), "command-unknown");
}

TEST(ClientJudge, WantsTheGreetingWhereItWasSeenToBeMissing) {
  Log log;
  log.v2(0, V2Command::Wake, {}, 0).v2_answer(90, V2Command::Wake, 0);
  auto all = conversation(log.text);
  EXPECT_EQ(ids(judge(all, Packets::V2)), "");
  all.carrier = Carrier::Gatt;
  all.has_lock = true;
  EXPECT_EQ(ids(judge(all, Packets::V2)), "greeting-missing");
  EXPECT_EQ(judge(all, Packets::V2).mistakes.front().severity, Severity::Warning); // they obey
  all.kind = spec::Robot::Rvr;
  EXPECT_EQ(ids(judge(all, Packets::V2)), "");
  all.kind = spec::Robot::Bolt;
  EXPECT_EQ(ids(judge(all, Packets::V2)), "greeting-missing");
  LogLine greeting;
  const auto word = as_bytes("usetheforce...band");
  greeting.bytes.assign(word.begin(), word.end());
  greeting.direction = Direction::ToBall;
  greeting.greets = true;
  all.lines.insert(all.lines.begin(), greeting);
  EXPECT_EQ(ids(judge(all, Packets::V2)), "");
}

TEST(ClientJudge, LetsAClientTryWhichPacketsTheRobotSpeaks) {
  const std::string v1 = "0.000 > FF FF 00 01 00 01 FD\n";
  const std::string v2 = "0.500 > 8D 0A 13 0D 01 D4 D8\n0.520 < 8D 09 13 0D 01 00 D5 D8\n";
  const auto judged_v2 = [](const std::string& log) {
    return ids(judge(conversation(log), Packets::V2));
  };
  EXPECT_EQ(judged_v2(v1 + v2), "");
  EXPECT_EQ(judged_v2("0.000 > FF FF 00 01\n" + v2), "wire-framing");
  // By now the client knows the packets.
  EXPECT_EQ(judged_v2(v2 + "0.900 > FF FF 00 01 00 01 FD\n"), "wire-framing");
}

TEST(ClientJudge, SaysNothingOfAnswersWhereTheLogHasNone) {
  Log log;
  log.v1(0, ApiCommand::Ping, {}, 0).v1(100, ApiCommand::Ping, {}, 0);
  EXPECT_EQ(judged(log.text), "");
}

TEST(ClientJudge, CountsPlacesAndKeepsTheFirst) {
  std::string log;
  for (int i = 0; i < 5; ++i)
    log += "> FF FF 00 01 01 01 AB\n";
  const auto judgement = judge(conversation(log), Packets::V1);
  ASSERT_EQ(judgement.mistakes.size(), 1U);
  EXPECT_EQ(judgement.mistakes[0].count, 5U);
  ASSERT_EQ(judgement.mistakes[0].places.size(), 3U);
  EXPECT_EQ(judgement.mistakes[0].places[2].number, 3U);
  EXPECT_EQ(judgement.commands, 5U);
  EXPECT_FALSE(judgement.is_clean());
}

RC_GTEST_PROP(ClientJudge, JudgesAnything,
              (const std::vector<std::pair<bool, Bytes>>& said, bool is_v2)) {
  Conversation all;
  all.has_start = all.has_end = true;
  for (const auto& [out, bytes] : said) {
    LogLine line;
    line.direction = out ? Direction::ToBall : Direction::FromBall;
    line.bytes = is_v2 ? Bytes{spec::v2_start} : Bytes{spec::sop1, spec::sop2_default};
    line.bytes.insert(line.bytes.end(), bytes.begin(), bytes.end());
    all.lines.push_back(std::move(line));
  }
  for (const auto& mistake : judge(all, is_v2 ? Packets::V2 : Packets::V1).mistakes)
    RC_ASSERT(mistake.count >= mistake.places.size() && !mistake.places.empty());
}

} // namespace
} // namespace orb::protocol
