#include "tests/unit/uploader/model_ball.h"

#include <gtest/gtest.h>

namespace orb::uploader {
namespace {

using spec::ApiCommand;
using Kind = Report::Kind;

/// Uploads the 60-line program over a transport, including the greeting.
Report upload_program(protocol::Transport& link, const ProgramJob& job, std::uint8_t first_seq = 0,
                      BatteryPolicy battery = BatteryPolicy::Refuse) {
  Session session(link, Budgets{}, first_seq);
  const auto greeting = greet(session);
  if (!greeting)
    return greeting.error();
  NullProgress progress;
  return upload(session, job, *greeting, battery, progress);
}

Report upload_macro(ModelBall& ball, const MacroJob& job) {
  Session session(ball, Budgets{}, 7);
  const auto greeting = greet(session);
  if (!greeting)
    return greeting.error();
  NullProgress progress;
  return upload(session, job, progress);
}

bool is(const protocol::Command& command, ApiCommand which) {
  return spec::api_command(command.did, command.cid) == which;
}

/// Drops only the n-th command of a kind; `extra` runs before.
ModelBall::Mischief at(ApiCommand which, int number, const std::function<void()>& extra = {}) {
  auto seen = std::make_shared<int>(0);
  return [=](int, const protocol::Command& command) -> std::optional<Bytes> {
    if (!is(command, which) || ++*seen != number)
      return std::nullopt;
    if (extra)
      extra();
    return Bytes{};
  };
}

ModelBall::Mischief silent_from(ApiCommand which) {
  auto silent = std::make_shared<bool>(false);
  return [=](int, const protocol::Command& command) -> std::optional<Bytes> {
    *silent = *silent || is(command, which);
    return *silent ? std::optional(Bytes{}) : std::nullopt;
  };
}

TEST(Upload, StoresTheProgramAsPlanned) {
  ModelBall ball;
  const ProgramJob job{sixty_lines(), Area::Ram, std::uint16_t{10}};
  const auto plan = make_plan(job, default_capabilities(), Budgets{});
  ASSERT_TRUE(plan.has_value());
  EXPECT_LE(plan->pieces, 5U);
  EXPECT_EQ(upload_program(ball, job, 0x42).kind, Kind::Done);
  EXPECT_EQ(ball.areas[0], as_string(job.image));
  EXPECT_EQ(ball.executed, 1);
  Bytes planned;
  for (const auto& packet : packets(*plan, 0x42))
    encode(packet, planned);
  EXPECT_EQ(to_hex(ball.received), to_hex(planned));
}

TEST(Upload, ReachesFlashThroughRam) {
  ModelBall ball;
  EXPECT_EQ(upload_program(ball, {sixty_lines(), Area::Flash, {}}).kind, Kind::Done);
  EXPECT_EQ(ball.areas[1], as_string(sixty_lines()));
}

TEST(Upload, WritesFlashDirectlyWhereThereIsNoCommit) {
  ModelBall ball;
  ball.versions = {0x02, 0x02, 0x03, 0x01, 0x2E, 0x20, 0x15, 0x04, 0x01, 0x2E}; // API 1.46
  EXPECT_EQ(upload_program(ball, {sixty_lines(), Area::Flash, {}}).kind, Kind::Done);
  EXPECT_EQ(ball.areas[1], as_string(sixty_lines()));
  EXPECT_EQ(ball.areas[0], "old\n");
}

TEST(Upload, SaysWhatDoesNotFitBeforeItErases) {
  ModelBall ball;
  ball.versions = {0x01, 0x02, 0x03, 0x01, 0x10, 0x20, 0x12, 0x04};
  const auto report = upload_program(ball, {Bytes(1025, ' '), Area::Ram, {}});
  EXPECT_EQ(report.kind, Kind::Impossible);
  EXPECT_NE(report.message.find("1025"), std::string::npos) << report.message;
  EXPECT_EQ(ball.areas[0], "old\n");
}

TEST(Upload, RefusesFlashOnALowBatteryUnlessTold) {
  for (const int power : {3, 4}) {
    ModelBall ball;
    ball.power = power;
    const auto report = upload_program(ball, {sixty_lines(), Area::Flash, {}});
    EXPECT_EQ(report.kind, Kind::Refused);
    EXPECT_EQ(ball.areas[1], "old flash\n");
    EXPECT_EQ(upload_program(ball, {sixty_lines(), Area::Flash, {}}, 0, BatteryPolicy::Ignore).kind,
              Kind::Done);
    EXPECT_EQ(upload_program(ball, {sixty_lines(), Area::Ram, {}}).kind, Kind::Done);
  }
}

TEST(Upload, ReportsAFullStorage) {
  ModelBall ball;
  ball.room[0] = 500;
  const auto report = upload_program(ball, {sixty_lines(), Area::Ram, {}});
  EXPECT_EQ(report.kind, Kind::Refused);
  EXPECT_EQ(report.code, 8);
  EXPECT_NE(report.message.find("append-orbbasic-fragment"), std::string::npos) << report.message;
}

TEST(Upload, ResendsWhatTheBallCallsDamaged) {
  ModelBall ball;
  int seen = 0;
  ball.mischief = [&](int, const protocol::Command& command) -> std::optional<Bytes> {
    if (!is(command, ApiCommand::AppendOrbbasicFragment) || ++seen != 3)
      return std::nullopt;
    return encode(protocol::Response{2, command.seq, {}});
  };
  EXPECT_EQ(upload_program(ball, {sixty_lines(), Area::Ram, {}}).kind, Kind::Done);
  EXPECT_EQ(ball.areas[0], as_string(sixty_lines()));
}

TEST(Upload, StartsOverAfterALostAnswer) {
  ModelBall ball;
  int seen = 0;
  ball.mischief = [&](int, const protocol::Command& command) -> std::optional<Bytes> {
    if (!is(command, ApiCommand::AppendOrbbasicFragment) || ++seen != 3)
      return std::nullopt;
    ball.areas[0].append(command.data.begin() + 1, command.data.end()); // stored, not answered
    return Bytes{};
  };
  EXPECT_EQ(upload_program(ball, {sixty_lines(), Area::Ram, {}}).kind, Kind::Done);
  EXPECT_EQ(ball.areas[0], as_string(sixty_lines()));
}

TEST(Upload, StartsOverAfterASecondAnswer) {
  // The first fragment, and the last, whose duplicate only the ping reveals.
  for (const int which : {1, 5}) {
    ModelBall ball;
    int seen = 0;
    ball.mischief = [&](int, const protocol::Command& command) -> std::optional<Bytes> {
      if (!is(command, ApiCommand::AppendOrbbasicFragment) || ++seen != which)
        return std::nullopt;
      ball.carry_out(command);
      ball.carry_out(command); // the link has doubled the request
      return Bytes{};
    };
    EXPECT_EQ(upload_program(ball, {sixty_lines(), Area::Ram, {}}).kind, Kind::Done);
    EXPECT_EQ(ball.areas[0], as_string(sixty_lines()));
  }
}

TEST(Upload, StartsOverWhereARequestArrivedTwiceAndOneAnswerWasLost) {
  for (const int which : {1, 5}) {
    ModelBall ball;
    int seen = 0;
    ball.mischief = [&](int, const protocol::Command& command) -> std::optional<Bytes> {
      if (!is(command, ApiCommand::AppendOrbbasicFragment) || ++seen != which)
        return std::nullopt;
      auto unanswered = command;
      unanswered.flags = 0;
      ball.carry_out(unanswered);
      ball.carry_out(command);
      return Bytes{};
    };
    EXPECT_EQ(upload_program(ball, {sixty_lines(), Area::Ram, {}}).kind, Kind::Done);
    EXPECT_EQ(ball.areas[0], as_string(sixty_lines()));
  }
}

TEST(Upload, GoesOnWithABallThatDoesNotCountAsItDoes) {
  for (const std::uint32_t counts_per_packet : {0U, 2U}) {
    ModelBall ball;
    ball.counts_per_packet = counts_per_packet;
    EXPECT_EQ(upload_program(ball, {sixty_lines(), Area::Ram, {}}).kind, Kind::Done);
    EXPECT_LE(ball.now().time_since_epoch(), 2s);
  }
  ModelBall refusing;
  refusing.has_diagnostics = false;
  EXPECT_EQ(upload_program(refusing, {sixty_lines(), Area::Ram, {}}).kind, Kind::Done);
  ModelBall silent;
  silent.mischief = [](int, const protocol::Command& command) -> std::optional<Bytes> {
    return is(command, ApiCommand::PerformLevel2Diagnostics) ? std::optional(Bytes{})
                                                             : std::nullopt;
  };
  EXPECT_EQ(upload_program(silent, {sixty_lines(), Area::Ram, {}}).kind, Kind::Done);
}

TEST(Upload, ForgetsWhatTheProgramBeforeSaid) {
  for (const auto last : {ApiCommand::AbortOrbbasicProgram, ApiCommand::AppendOrbbasicFragment}) {
    ModelBall ball;
    ball.mischief = [&](int, const protocol::Command& command) -> std::optional<Bytes> {
      if (!is(command, last))
        return std::nullopt;
      ball.carry_out(command);
      return encode(protocol::Async{static_cast<std::uint8_t>(spec::AsyncId::BasicError), {0, 20}});
    };
    ball.print_at_start = "mine";
    Session session(ball, Budgets{}, 0);
    const auto greeting = greet(session);
    NullProgress progress;
    EXPECT_EQ(upload(session, {sixty_lines(), Area::Ram, std::uint16_t{10}}, *greeting,
                     BatteryPolicy::Refuse, progress)
                  .kind,
              Kind::Done);
    (void)session.listen(session.now() + 1s);
    ASSERT_EQ(session.inbox().size(), 1U);
    EXPECT_EQ(as_string(session.inbox().front().data), "mine");
  }
}

TEST(Upload, SaysWhatIsOnABallThatFallsSilent) {
  struct Case {
    ApiCommand from;
    Area area;
    Kind kind;
    Content content;
  };
  for (const auto& [from, area, kind, content] :
       {Case{ApiCommand::Ping, Area::Ram, Kind::NoBall, Content::Unchanged},
        Case{ApiCommand::AbortOrbbasicProgram, Area::Ram, Kind::LinkLost, Content::Unchanged},
        Case{ApiCommand::EraseOrbbasicStorage, Area::Ram, Kind::LinkLost,
             Content::ErasedOrUnchanged},
        Case{ApiCommand::AppendOrbbasicFragment, Area::Ram, Kind::LinkLost, Content::Incomplete},
        Case{ApiCommand::CommitRamToFlash, Area::Flash, Kind::Unknown, Content::Unconfirmed},
        Case{ApiCommand::ExecuteOrbbasicProgram, Area::Ram, Kind::Unknown, Content::Stored}}) {
    ModelBall ball;
    ball.mischief = silent_from(from);
    const ProgramJob job{sixty_lines(), area, std::uint16_t{10}};
    const auto start = ball.now();
    const auto report = upload_program(ball, job);
    EXPECT_EQ(report.kind, kind) << report.message;
    EXPECT_EQ(report.content, content) << report.message;
    EXPECT_LE(ball.now() - start, make_plan(job, default_capabilities(), Budgets{})->deadline);
    EXPECT_LE(ball.now() - start, 40s) << report.message;
  }
}

TEST(Upload, ReportsALinkThatBreaks) {
  ModelBall ball;
  ball.mischief = at(ApiCommand::AppendOrbbasicFragment, 2, [&] {
    ball.broken = protocol::LinkError{protocol::LinkError::Kind::Closed, "the ball hung up"};
  });
  const auto report = upload_program(ball, {sixty_lines(), Area::Flash, {}});
  EXPECT_EQ(report.kind, Kind::LinkLost);
  EXPECT_NE(report.message.find("the ball hung up"), std::string::npos);
  EXPECT_NE(report.message.find("flash is unchanged"), std::string::npos) << report.message;
}

TEST(Upload, ReportsAnInterruption) {
  ModelBall ball;
  ball.mischief = at(ApiCommand::AppendOrbbasicFragment, 2, [&] {
    ball.broken = protocol::LinkError{protocol::LinkError::Kind::Interrupted, "interrupted"};
  });
  const auto report = upload_program(ball, {sixty_lines(), Area::Ram, {}});
  EXPECT_EQ(report.kind, Kind::Interrupted);
  EXPECT_NE(report.message.find("incomplete"), std::string::npos) << report.message;
}

TEST(Upload, SaysWhatIsOnTheBallWhereverItEnds) {
  using LinkKind = protocol::LinkError::Kind;
  for (const auto command :
       {ApiCommand::GetVersioning, ApiCommand::GetPowerState, ApiCommand::ExecuteOrbbasicProgram})
    for (const auto kind : {LinkKind::Closed, LinkKind::Interrupted}) {
      ModelBall ball;
      ball.mischief = at(command, 1, [&] { ball.broken = protocol::LinkError{kind, "cut"}; });
      const auto report = upload_program(ball, {sixty_lines(), Area::Ram, std::uint16_t{10}});
      const auto stored = command == ApiCommand::ExecuteOrbbasicProgram;
      EXPECT_NE(report.message.find(stored ? "stored" : "unchanged"), std::string::npos)
          << report.message;
      EXPECT_EQ(stored && report.message.find("again") != std::string::npos, false)
          << report.message;
    }
}

TEST(Upload, TakesAPrintForTheStart) {
  ModelBall ball;
  ball.mischief = [&](int, const protocol::Command& command) -> std::optional<Bytes> {
    if (!is(command, ApiCommand::ExecuteOrbbasicProgram))
      return std::nullopt;
    return encode(protocol::Async{static_cast<std::uint8_t>(spec::AsyncId::BasicPrint), {'x'}});
  };
  EXPECT_EQ(upload_program(ball, {sixty_lines(), Area::Ram, std::uint16_t{10}}).kind, Kind::Done);
}

TEST(Upload, NeverSendsAStartTwice) {
  ModelBall ball;
  ball.mischief = [&](int, const protocol::Command& command) -> std::optional<Bytes> {
    if (!is(command, ApiCommand::ExecuteOrbbasicProgram))
      return std::nullopt;
    ++ball.executed;
    return Bytes{};
  };
  const auto report = upload_program(ball, {sixty_lines(), Area::Ram, std::uint16_t{10}});
  EXPECT_EQ(report.kind, Kind::Unknown);
  EXPECT_NE(report.message.find("stored, start not confirmed"), std::string::npos);
  EXPECT_EQ(ball.executed, 1);
}

TEST(Upload, RefusesAllOfADeliveryBeforeAnyOfItIsSent) {
  const MacroJob macro{
      {.id = 40, .flags = 1, .extended_flags = {}, .body = {0}}, MacroKind::User, false, false};
  const auto changed_by = [&](const ProgramJob& job, int power, bool fits) {
    ModelBall ball;
    ball.power = power;
    Session session(ball, Budgets{}, 0);
    NullProgress progress;
    Delivery delivery{{{"blink", macro}}, "big.bas", job};
    if (!fits)
      delivery.misfit = [](const Greeting&) { return std::string("it lacks a word"); };
    const auto report = deliver(session, delivery, BatteryPolicy::Refuse, progress);
    EXPECT_NE(report.kind, Kind::Done);
    return !ball.macros.empty() || ball.areas[0] != "old\n";
  };
  EXPECT_FALSE(changed_by({Bytes(5000, ' '), Area::Ram, {}}, 2, true)) << "too large";
  EXPECT_FALSE(changed_by({sixty_lines(), Area::Flash, {}}, 3, true)) << "battery low";
  EXPECT_FALSE(changed_by({sixty_lines(), Area::Ram, {}}, 2, false));
}

/// Sends what a program prints. Returns how long await_start() waits.
Duration start_after(const std::vector<spec::AsyncId>& said, Duration latency) {
  ModelBall ball;
  ball.latency = latency;
  Session session(ball, Budgets{}, 0);
  for (const auto id : said)
    ball.send(encode(protocol::Async{static_cast<std::uint8_t>(id), {0, 20, 0, 8}}));
  const auto begin = session.now();
  EXPECT_TRUE(await_start(session));
  return session.now() - begin;
}

TEST(Upload, WaitsForTheFirstWordOfAProgramOrASecond) {
  using enum spec::AsyncId;
  EXPECT_EQ(start_after({}, {}), 1s);
  EXPECT_EQ(start_after({SensorData}, {}), 1s);
  EXPECT_EQ(start_after({BasicError}, 10ms), 20ms);
  EXPECT_EQ(start_after({BasicPrint, BasicError}, 10ms), 20ms);
  EXPECT_EQ(start_after({BasicPrint}, 10ms), 20ms + 200ms) << "an error may be behind it";
}

TEST(Upload, BrakesWhateverDroveTheWheels) {
  ModelBall ball;
  Session session(ball, Budgets{}, 0);
  ASSERT_TRUE(brake(session));
  protocol::Decoder decoder(protocol::Direction::ToBall);
  decoder.feed(ball.received);
  std::vector<std::string_view> names;
  while (const auto item = decoder.next())
    names.push_back(spec::find_command(item->did, item->cid)->name);
  EXPECT_EQ(names,
            (std::vector<std::string_view>{"set-raw-motor-values", "set-stabilization", "roll"}));
}

TEST(Upload, TellsWhatIsNoBall) {
  const auto report_of = [](const ModelBall::Mischief& mischief) {
    ModelBall ball;
    ball.mischief = mischief;
    return upload_program(ball, {sixty_lines(), Area::Ram, {}});
  };
  const auto echo = report_of(
      [](int, const protocol::Command& command) { return std::optional(encode(command)); });
  EXPECT_EQ(echo.kind, Kind::NoBall);
  EXPECT_NE(echo.message.find("echo"), std::string::npos) << echo.message;
  const auto wrong_seq = report_of([](int, const protocol::Command& command) {
    return std::optional(
        encode(protocol::Response{0, static_cast<std::uint8_t>(command.seq + 100), {}}));
  });
  EXPECT_EQ(wrong_seq.kind, Kind::NoBall);
  EXPECT_NE(wrong_seq.message.find("sequence numbers"), std::string::npos) << wrong_seq.message;
  const auto shell = report_of([](int, const protocol::Command&) {
    const std::string_view text = "sh: command not found\n$ ";
    return std::optional(Bytes(text.begin(), text.end()));
  });
  EXPECT_EQ(shell.kind, Kind::NoBall);
  EXPECT_NE(shell.message.find("not a ball"), std::string::npos) << shell.message;
}

protocol::MacroImage macro_of(std::uint8_t id, std::size_t commands) {
  protocol::MacroImage image;
  image.id = id;
  image.flags = 1;
  for (std::size_t i = 0; i < commands; ++i)
    protocol::append_macro_command(image.body, spec::MacroCommand::Delay,
                                   std::array<std::int32_t, 1>{static_cast<std::int32_t>(i)});
  protocol::append_macro_command(image.body, spec::MacroCommand::End, {});
  return image;
}

TEST(UploadMacro, BringsATemporaryOneInOnePacket) {
  ModelBall ball;
  EXPECT_EQ(upload_macro(ball, {macro_of(40, 20), MacroKind::Temporary, true}).kind, Kind::Done);
  EXPECT_EQ(ball.macros.at(255), encode(macro_of(255, 20)));
  EXPECT_EQ(ball.running, 255);
}

TEST(UploadMacro, BringsALongOneInChunks) {
  ModelBall ball;
  EXPECT_EQ(upload_macro(ball, {macro_of(255, 300), MacroKind::Temporary, true}).kind, Kind::Done);
  EXPECT_EQ(ball.chunks, encode(macro_of(255, 300)));
}

TEST(UploadMacro, LeavesALostChunkUnknown) {
  ModelBall ball;
  ball.mischief = at(ApiCommand::AppendMacroChunk, 2);
  const auto report = upload_macro(ball, {macro_of(255, 300), MacroKind::Temporary, true});
  EXPECT_EQ(report.kind, Kind::Unknown);
  EXPECT_TRUE(ball.chunks.empty()); // aborted
}

TEST(UploadMacro, CallsAChunkThatArrivedTwiceUnknown) {
  ModelBall ball;
  int seen = 0;
  ball.mischief = [&](int, const protocol::Command& command) -> std::optional<Bytes> {
    if (!is(command, ApiCommand::AppendMacroChunk) || ++seen != 2)
      return std::nullopt;
    auto unanswered = command;
    unanswered.flags = 0;
    ball.carry_out(unanswered);
    return std::nullopt;
  };
  const auto report = upload_macro(ball, {macro_of(255, 300), MacroKind::Temporary, true});
  EXPECT_EQ(report.kind, Kind::Unknown);
  EXPECT_TRUE(ball.chunks.empty()); // aborted
}

TEST(UploadMacro, StreamsAnyLengthAtThePaceOfTheBall) {
  ModelBall ball;
  const auto image = macro_of(254, 3000);
  auto calls = 0;
  ball.mischief = [&](int, const protocol::Command& command) -> std::optional<Bytes> {
    if (is(command, ApiCommand::SaveMacro) && ++calls % 3 == 0)
      ball.stream_refusals = 1;
    return std::nullopt;
  };
  const auto report = upload_macro(ball, {image, MacroKind::Stream, true});
  EXPECT_EQ(report.kind, Kind::Done) << report.message;
  auto expected = image.body;
  expected.push_back(static_cast<std::uint8_t>(spec::MacroCommand::StreamEnd));
  EXPECT_EQ(ball.stream, expected);
}

TEST(UploadMacro, SavesUnderAnIdAndSaysWhenItExists) {
  ModelBall ball;
  EXPECT_EQ(upload_macro(ball, {macro_of(40, 20), MacroKind::User, true}).kind, Kind::Done);
  EXPECT_EQ(ball.macros.at(40), encode(macro_of(40, 20)));
  const auto again = upload_macro(ball, {macro_of(40, 20), MacroKind::User});
  EXPECT_EQ(again.kind, Kind::Refused);
  EXPECT_NE(again.message.find("--clear-macros"), std::string::npos) << again.message;
  EXPECT_EQ(upload_macro(ball, {macro_of(40, 5), MacroKind::User, false, true}).kind, Kind::Done);
  EXPECT_EQ(ball.macros.at(40), encode(macro_of(40, 5)));
}

TEST(UploadMacro, TakesExistsForSuccessOnlyWhereTheIdWasFree) {
  for (const bool cleared : {true, false}) {
    ModelBall ball;
    int seen = 0;
    ball.mischief = [&](int, const protocol::Command& command) -> std::optional<Bytes> {
      if (!is(command, ApiCommand::SaveMacro) || ++seen != 1)
        return std::nullopt;
      ball.macros[40] = command.data;
      return Bytes{};
    };
    const auto report = upload_macro(ball, {macro_of(40, 20), MacroKind::User, false, cleared});
    EXPECT_EQ(report.kind, cleared ? Kind::Done : Kind::Unknown) << report.message;
  }
}

TEST(UploadMacro, AsksForTheStatusAfterALostStart) {
  for (const bool runs : {true, false}) {
    ModelBall ball;
    ball.mischief = at(ApiCommand::RunMacro, 1, [&] { ball.running = runs ? 255 : 0; });
    EXPECT_EQ(upload_macro(ball, {macro_of(255, 20), MacroKind::Temporary, true}).kind,
              runs ? Kind::Done : Kind::Unknown);
  }
}

TEST(UnseenBound, IsNothingWhereNothingIsDoubledOrNothingIsLost) {
  EXPECT_EQ(unseen_bound(5, 0, 0.1), 0);
  EXPECT_EQ(unseen_bound(5, 0.1, 0), 0);
  EXPECT_EQ(unseen_bound(0, 0.1, 0.1), 0);
}

TEST(UnseenBound, GrowsWithThePieces) {
  // Of pieces that look right, 0.01 · 2 · 0.01 · 0.99 out of 0.99 + 0.01 · 2 · 0.01 arrived twice.
  EXPECT_NEAR(unseen_bound(1, 0.01, 0.01), 0.000198 / (0.9902 + 0.000198), 1e-9);
  EXPECT_NEAR(unseen_bound(5, 0.01, 0.01), 0.000999, 1e-6);
}

} // namespace
} // namespace orb::uploader
