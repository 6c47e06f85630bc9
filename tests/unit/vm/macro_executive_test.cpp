#include "vm/macros/macro_executive.h"

#include "vm/macros/system_macros.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace orb::vm {
namespace {

using spec::MacroCommand;

/// Records the executive's requests, with the time in milliseconds.
class Log : public MacroHost {
public:
  Instant now{};
  Instant zero{}; ///< time 0 of the log
  bool stands = true;
  bool client = true;
  int commands = 0;
  bool quiet = false;
  std::string text;

  void add(const std::string& line) {
    if (!quiet)
      text += fmt::format("{} {}\n", (now - zero) / 1ms, line);
  }
  std::string take() { return std::exchange(text, {}); }

  void drive(const Motion& motion) override {
    std::visit([&](const auto& one) { note(one); }, motion);
  }
  void note(Stabilization mode) { add(fmt::format("stabilize {}", static_cast<int>(mode))); }
  void note(const SetHeading& name) { add(fmt::format("heading {}", name.heading_deg)); }
  void note(const Roll& roll) { add(fmt::format("roll {} {}", roll.speed, roll.heading_deg)); }
  void note(const SetSpeed& change) { add(fmt::format("speed {}", change.speed)); }
  void note(const Motors& m) {
    add(fmt::format("raw {} {} {} {}", static_cast<int>(m.left.mode), m.left.power,
                    static_cast<int>(m.right.mode), m.right.power));
  }
  void note(const Rotate& turn) {
    add(fmt::format("rotate {} {}", turn.angle_deg, turn.time / 1ms));
  }
  void note(const Stop&) { add("stop motors"); }
  void note(const RotationRate& rate) { add(fmt::format("rate {}", rate.deg_per_s)); }
  void set_led(Color c) override { add(fmt::format("rgb {} {} {}", c.red, c.green, c.blue)); }
  void set_back_led(int value) override { add(fmt::format("back {}", value)); }
  void configure_collisions(const CollisionSettings& s) override {
    add(fmt::format("collision {} {} {} {} {} {}", s.method, s.x_threshold, s.x_speed,
                    s.y_threshold, s.y_speed, s.dead_time_10ms));
  }
  void emit_marker(int marker, int id, int number) override {
    add(fmt::format("marker {:02X} {:02X} {}", marker, id, number));
  }
  void trace_command(int, int) override { ++commands; }
  void sleep_ms(int time) override { add(fmt::format("sleep {}", time)); }
  bool stopped() const override { return stands; }
  bool connected() const override { return client; }
};

class Executive : public ::testing::Test {
protected:
  Log log;
  MacroExecutive executive{log};

  void note_ending() {
    static constexpr const char* names[] = {
        "ended", "aborted", "no such macro", "bad command", "stream end", "inhibited", "slept"};
    if (const auto stop = executive.take_finished())
      log.add(fmt::format("{} {}", names[static_cast<int>(stop->end.reason)], stop->end.command));
  }

  /// Advances event by event, so that the log knows the time of each.
  void advance_ms(int ms) {
    const auto until = log.now + std::chrono::milliseconds(ms);
    while (executive.next_event() <= until) {
      log.now = executive.next_event();
      executive.advance_to(log.now);
      note_ending();
    }
    log.now = until;
    executive.advance_to(until);
  }
  void load(std::string_view hex) {
    ASSERT_EQ(executive.save(*from_hex(hex), log.now), MacroOutcome::Done) << hex;
  }
  std::string run(std::string_view hex, int ms = 100000) {
    EXPECT_EQ(executive.save_temporary(*from_hex(hex), log.now), MacroOutcome::Done);
    EXPECT_EQ(executive.start(spec::macro_id_temporary, log.now), MacroOutcome::Done);
    log.zero = log.now;
    advance_ms(ms);
    return log.take();
  }
};

TEST_F(Executive, MarkersCarryTheIdAndTheNumberOfTheCommand) {
  EXPECT_EQ(run("FF 14 15 AA 15 BB 00"),
            "0 marker AA FF 1\n0 marker BB FF 2\n0 marker 00 FF 3\n0 ended 3\n");
  // A comment counts, too.
  EXPECT_EQ(run("FF 14 20 00 02 61 62 15 AA 15 BB 00", 0),
            "0 marker AA FF 2\n0 marker BB FF 3\n0 marker 00 FF 4\n0 ended 4\n");
}

TEST_F(Executive, AbortsAtACommandThatIsNewerThanItself) {
  MacroExecutive old{log, 2};
  ASSERT_EQ(old.save_temporary(*from_hex("FF 00 15 AA 1E 03 1F 00"), log.now), MacroOutcome::Done);
  ASSERT_EQ(old.start(spec::macro_id_temporary, log.now), MacroOutcome::Done);
  old.advance_to(log.now + 1s);
  EXPECT_EQ(log.take(), "0 marker AA FF 1\n");
  const auto stop = old.take_finished();
  ASSERT_TRUE(stop);
  EXPECT_EQ(stop->end.reason, event::MacroEnd::Reason::BadCommand);
  EXPECT_EQ(old.start(2, log.now), MacroOutcome::Done) << "its own macros it knows";
  old.advance_to(log.now + 10s);
  EXPECT_EQ(old.take_finished()->end.reason, event::MacroEnd::Reason::Ended);
}

TEST_F(Executive, AUserMacroKeepsItsId) {
  load("40 14 15 AA 15 BB 00");
  EXPECT_EQ(executive.start(0x40, log.now), MacroOutcome::Done);
  EXPECT_EQ(log.take(), "") << "nothing happens before time is given";
  advance_ms(0);
  EXPECT_EQ(log.take(), "0 marker AA 40 1\n0 marker BB 40 2\n0 marker 00 40 3\n0 ended 3\n");
}

TEST_F(Executive, CommandsWaitForTheirDelay) {
  EXPECT_EQ(run("FF 00 05 80 00 5A 64 1D 80 00 5A 03 E8 0B 00 0A 25 00 32 00"),
            "0 roll 128 90\n100 roll 128 90\n1110 speed 0\n1160 ended 5\n");
}

TEST_F(Executive, SystemDelaysAndSpeedsAreInherited) {
  EXPECT_EQ(run("FF 00 01 00 0A 02 00 14 0F 40 10 41 06 7F 00 01 11 00 02 12 00 03 08 01 02 03 00"),
            "0 roll 127 1\n10 roll 64 2\n20 roll 65 3\n30 rgb 1 2 3\n50 ended 9\n");
}

TEST_F(Executive, TheApiChangesParametersWhileAMacroRuns) {
  // Two rounds of a roll with SD1, which is prolonged after the first.
  executive.set_parameter(0, 0, 50);
  executive.set_parameter(4, 2, 0);
  EXPECT_EQ(run("FF 00 24 06 7F 00 00 1F 00", 10), "0 roll 127 0\n");
  executive.set_parameter(0, 0x01, 0x00);
  advance_ms(1000);
  EXPECT_EQ(log.take(), "50 roll 127 0\n306 ended 4\n");
  EXPECT_EQ(executive.set_parameter(5, 0, 0), MacroOutcome::BadParameter);
}

TEST_F(Executive, ALoopRepeatsAndZeroCountsAsOne) {
  EXPECT_EQ(run("FF 00 1E 03 15 05 1F 1E 00 15 06 1F 00"),
            "0 marker 05 FF 2\n0 marker 05 FF 2\n0 marker 05 FF 2\n0 marker 06 FF 5\n0 ended 7\n");
}

TEST_F(Executive, ASecondLoopStartReplacesTheFirst) {
  EXPECT_EQ(run("FF 00 1E 09 15 01 1E 02 15 02 1F 15 03 1F 00"),
            "0 marker 01 FF 2\n0 marker 02 FF 4\n0 marker 02 FF 4\n0 marker 03 FF 6\n0 ended 8\n");
}

TEST_F(Executive, ALoopEndOfAnotherMacroIsIgnored) {
  load("20 00 15 0B 1F 00");
  EXPECT_EQ(run("FF 00 1E 02 15 0A 0D 20 1F 00"),
            "0 marker 0A FF 2\n0 marker 0B 20 1\n0 marker 0A FF 2\n0 marker 0B 20 1\n0 ended 5\n");
}

TEST_F(Executive, GosubReturnsOnceDeepAndIsIgnoredDeeper) {
  load("20 10 15 0B 0D 21 00"); // its own gosub finds a full stack
  load("21 00 15 0C 00");
  EXPECT_EQ(run("FF 00 0D 20 15 0A 00"),
            "0 marker 0B 20 1\n0 marker 00 20 3\n0 marker 0A FF 2\n0 ended 3\n");
}

TEST_F(Executive, AMacroThatCallsItselfAtItsEndRunsTwice) {
  EXPECT_EQ(run("FF 00 15 0A 0D FF 00"), "0 marker 0A FF 1\n0 marker 0A FF 1\n0 ended 3\n");
}

TEST_F(Executive, GotoTakesTheFlagsOfItsTargetAndGosubGivesThemBack) {
  load("20 01 00");
  load("21 00 00");
  EXPECT_EQ(run("FF 00 0C 20"), "0 stop motors\n0 ended 1\n");
  EXPECT_EQ(run("FF 01 0C 21", 0), "0 ended 1\n");
  EXPECT_EQ(run("FF 01 0D 21 00", 0), "0 stop motors\n0 ended 2\n");
  EXPECT_EQ(run("FF 00 0D 20 00", 0), "0 ended 2\n") << "a callee's exit is not the macro's";
}

TEST_F(Executive, GotoANonexistentOrTheStreamMacroAborts) {
  EXPECT_EQ(run("FF 01 0C 99 15 01 00"), "0 stop motors\n0 no such macro 1\n");
  EXPECT_EQ(run("FF 00 0C FE 00", 0), "0 no such macro 1\n");
  EXPECT_EQ(run("FF 00 0D 99 00", 0), "0 no such macro 1\n");
}

TEST_F(Executive, AJumpToItselfLetsTimePass) {
  // 64 commands a tick, of which every other one is a marker.
  EXPECT_EQ(run("FF 00 15 01 0C FF", 1).size(), 2 * 32 * std::string("0 marker 01 FF 1\n").size());
  EXPECT_EQ(executive.abort(log.now), (MacroStatus{0xFF, 0}));
}

TEST_F(Executive, AFadeGoesOnBehindTheOtherCommands) {
  EXPECT_EQ(run("FF 00 07 64 00 00 00 14 00 04 00 00 04 0B 00 04 00"),
            "0 rgb 100 0 0\n1 rgb 75 1 0\n2 rgb 50 2 0\n3 rgb 25 3 0\n4 rgb 0 4 0\n4 ended 4\n");
}

TEST_F(Executive, AnEndOrAnotherColorEndsAFade) {
  EXPECT_EQ(run("FF 00 14 FF 00 00 00 FF 0B 00 01 00"), "1 rgb 1 0 0\n1 ended 3\n");
  EXPECT_EQ(run("FF 00 14 FF 00 00 00 FF 07 00 09 00 02 00", 5), "0 rgb 0 9 0\n2 ended 3\n");
}

TEST_F(Executive, ARollDuringARotationIsIgnoredButItsDelayIsNot) {
  EXPECT_EQ(run("FF 00 1A FD 30 00 0A 05 FF 00 00 05 05 FE 00 00 05 05 FD 00 00 00 00"),
            "0 rotate -720 10\n10 roll 253 0\n10 ended 5\n");
}

TEST_F(Executive, AMacroThatEndsStopsItsRotation) {
  EXPECT_EQ(run("FF 00 01 00 14 21 00 5A 0B 00 05 00"),
            "0 rotate 90 20\n5 rotate 0 0\n5 ended 4\n");
}

TEST_F(Executive, WaitUntilStoppedEndsWhenTheBallStandsOrTheTimeIsOver) {
  log.stands = false;
  EXPECT_EQ(run("FF 00 19 00 64 15 01 00", 40), "");
  log.stands = true;
  advance_ms(60);
  EXPECT_EQ(log.take(), "41 marker 01 FF 2\n41 ended 3\n");
  log.stands = false;
  EXPECT_EQ(run("FF 00 19 00 64 15 01 00"), "100 marker 01 FF 2\n100 ended 3\n");
}

TEST_F(Executive, ACollisionGoesToItsTarget) {
  load("20 00 15 0C 00");
  EXPECT_EQ(run("FF 00 23 20 0B 03 E8 15 0A 00", 300), "");
  executive.collide(log.now);
  advance_ms(10);
  EXPECT_EQ(log.take(), "300 marker 0C 20 1\n300 ended 2\n");
  // Off means off.
  EXPECT_EQ(run("FF 00 23 20 23 00 0B 00 0A 00", 5), "");
  executive.collide(log.now);
  advance_ms(10);
  EXPECT_EQ(log.take(), "10 ended 4\n");
}

TEST_F(Executive, SleepEndsTheMacro) {
  EXPECT_EQ(run("FF 01 0E 12 34 15 01 00"), "0 stop motors\n0 sleep 4660\n0 slept 1\n");
}

TEST_F(Executive, SettersReachTheBall) {
  EXPECT_EQ(
      run("FF 00 03 02 00 04 01 67 00 09 44 00 0A 01 55 02 66 00 13 80 27 01 02 03 04 05 06 00"),
      "0 stabilize 2\n0 heading 0\n0 back 68\n0 raw 1 85 2 102\n0 rate 104\n"
      "0 collision 1 2 3 4 5 6\n0 ended 7\n");
}

TEST_F(Executive, ValuesThatNoDocumentNamesAreTamed) {
  EXPECT_EQ(run("FF 00 03 07 00 05 FF FF FF 00 0A 09 01 08 02 00 00"),
            "0 stabilize 0\n0 roll 255 15\n0 raw 4 1 4 2\n0 ended 4\n");
}

TEST_F(Executive, BrokenBytesAbort) {
  EXPECT_EQ(run("FF 01 15 01 16 00"), "0 marker 01 FF 1\n0 stop motors\n0 bad command 1\n");
  EXPECT_EQ(run("FF 00 20 00 09 61 00", 0), "0 bad command 0\n");
  EXPECT_EQ(run("FF 00 1B 15 01 00", 0), "0 stream end 1\n");
}

TEST_F(Executive, AMissingEndIsTheLastByte) {
  EXPECT_EQ(run("FF 10 15 01"), "0 marker 01 FF 1\n0 marker 00 FF 1\n0 ended 1\n");
}

TEST_F(Executive, RunRefusesWhatItCannotRun) {
  EXPECT_EQ(executive.start(0, log.now), MacroOutcome::BadParameter);
  EXPECT_EQ(executive.start(254, log.now), MacroOutcome::BadParameter);
  EXPECT_EQ(executive.start(255, log.now), MacroOutcome::NoSuchMacro);
  EXPECT_EQ(executive.start(77, log.now), MacroOutcome::NoSuchMacro);
  load("40 08 0B 00 05 00");
  EXPECT_EQ(executive.start(0x40, log.now), MacroOutcome::Inhibited) << "inhibited while connected";
  log.client = false;
  EXPECT_EQ(executive.start(0x40, log.now), MacroOutcome::Done);
  EXPECT_EQ(executive.start(0x40, log.now), MacroOutcome::Busy) << "one runs already";
}

TEST_F(Executive, SaveRefusesSystemTakenAndTooMany) {
  for (const auto* hex : {"00 00 00", "01 00 00", "1F 00 00", "FF 00 00", "40", ""})
    EXPECT_EQ(executive.save(*from_hex(hex), log.now), MacroOutcome::BadParameter) << hex;
  load("20 00 00");
  EXPECT_EQ(executive.save(*from_hex("20 00 00"), log.now), MacroOutcome::NoRoom);
  for (int id = 33; id < 48; ++id)
    EXPECT_EQ(executive.save(Bytes{static_cast<std::uint8_t>(id), 0, 0}, log.now),
              MacroOutcome::Done);
  EXPECT_EQ(executive.save(*from_hex("50 00 00"), log.now), MacroOutcome::NoRoom) << "16 entries";
  executive.reinitialize(log.now);
  Bytes large(254, 0x1F);
  for (int id = 32; id < 40; ++id) {
    large[0] = static_cast<std::uint8_t>(id);
    EXPECT_EQ(executive.save(large, log.now), MacroOutcome::Done);
  }
  large[0] = 50;
  EXPECT_EQ(executive.save(large, log.now), MacroOutcome::NoRoom) << "2048 bytes";
}

TEST_F(Executive, AbortAndStatusNameTheCommandInProcess) {
  EXPECT_EQ(executive.abort(log.now), (MacroStatus{0, 0}));
  EXPECT_EQ(run("FF 01 15 01 0B 03 E8 00", 5), "0 marker 01 FF 1\n");
  EXPECT_EQ(executive.status(), (MacroStatus{0xFF, 2}));
  EXPECT_EQ(executive.abort(log.now), (MacroStatus{0xFF, 2}));
  EXPECT_EQ(log.take(), "5 stop motors\n");
  EXPECT_EQ(executive.status(), (MacroStatus{0, 2})) << "the number is left over";
  EXPECT_EQ(executive.abort(log.now), (MacroStatus{0, 0}));
}

TEST_F(Executive, OnlySystemMacrosAreUnkillable) {
  const auto* unkillable = &system_macros().front();
  for (const auto& macro : system_macros()) {
    EXPECT_EQ(macro.id, macro.image[0]);
    EXPECT_FALSE(protocol::decode_macro_body(macro.image.subspan(2)).error);
    if (spec::has_flag(macro.image[1], spec::MacroFlag::Unkillable))
      unkillable = &macro;
  }
  EXPECT_EQ(executive.start(unkillable->id, log.now), MacroOutcome::Done);
  advance_ms(1);
  EXPECT_EQ(executive.abort(log.now), (MacroStatus{unkillable->id, 0xFFFF}));
  executive.reinitialize(log.now);
  run("FF 40 0B 03 E8 00", 5);
  EXPECT_EQ(executive.abort(log.now), (MacroStatus{0xFF, 1}));
}

TEST_F(Executive, ChunksBuildOneLongTemporaryMacro) {
  // The first chunk ends inside the text of a comment.
  EXPECT_EQ(executive.append_chunk(*from_hex("40 14 20 00 04 61"), log.now), MacroOutcome::Done);
  EXPECT_EQ(executive.append_chunk(*from_hex("62 63 64 15 AA 00"), log.now), MacroOutcome::Done);
  EXPECT_EQ(executive.start(255, log.now), MacroOutcome::Done);
  advance_ms(1);
  EXPECT_EQ(log.take(), "0 marker AA FF 2\n0 marker 00 FF 3\n0 ended 3\n");
  const Bytes chunk(254, 0x1F);
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(executive.append_chunk(chunk, log.now), MacroOutcome::Done);
  EXPECT_EQ(executive.append_chunk(Bytes(251), log.now), MacroOutcome::NoRoom) << "12 + 762 + 251";
  EXPECT_EQ(executive.append_chunk(Bytes(250), log.now), MacroOutcome::Done);
  executive.abort(log.now);
  EXPECT_EQ(executive.append_chunk(*from_hex("FF 00 15 07 00"), log.now), MacroOutcome::Done);
  EXPECT_EQ(executive.start(255, log.now), MacroOutcome::Done);
  advance_ms(1);
  EXPECT_EQ(log.take(), "1 marker 07 FF 1\n1 ended 2\n") << "an abort begins a new macro";
}

TEST_F(Executive, ANewTemporaryMacroEndsTheOneThatRuns) {
  run("FF 01 0B 03 E8 00", 5);
  EXPECT_EQ(executive.save_temporary(*from_hex("FF 00 00"), log.now), MacroOutcome::Done);
  EXPECT_EQ(log.take(), "5 stop motors\n");
  EXPECT_FALSE(executive.running());
}

TEST_F(Executive, AStreamStartsAtOnceIgnoresEndAndWaitsForMore) {
  load("FE 10 15 01 00 0D 01 15 02");
  advance_ms(50);
  EXPECT_EQ(log.take(), "0 marker 01 FE 1\n0 marker 02 FE 4\n");
  EXPECT_TRUE(executive.running());
  EXPECT_EQ(executive.next_event(), never);
  load("FE 00 15 03 1B 15 04");
  advance_ms(50);
  EXPECT_EQ(log.take(), "50 marker 03 FE 5\n50 marker 00 FE 6\n50 ended 6\n");
  EXPECT_EQ(executive.start(255, log.now), MacroOutcome::NoSuchMacro)
      << "the buffer held the stream";
}

TEST_F(Executive, AFullStreamAsksForALittlePatience) {
  Bytes chunk{0xFE, 0x00};
  const auto roll = *from_hex("05 80 00 00 0A");
  for (int i = 0; i < 50; ++i)
    chunk.insert(chunk.end(), roll.begin(), roll.end());
  for (int i = 0; i < 4; ++i)
    EXPECT_EQ(executive.save(chunk, log.now), MacroOutcome::Done);
  EXPECT_EQ(executive.save(chunk, log.now), MacroOutcome::NoRoom);
  advance_ms(499);
  log.take();
  EXPECT_EQ(executive.save(chunk, log.now), MacroOutcome::Done) << "250 bytes are done with";
  advance_ms(5000);
  log.take();
  EXPECT_TRUE(executive.running());
  EXPECT_EQ(executive.status().number, 250);
}

TEST_F(Executive, ALoopInAStreamSurvivesTheNextChunk) {
  Bytes chunk{0xFE, 0x00, 0x1E, 0x02, 0x15, 0x0A};
  chunk.resize(252, 0x1F);
  std::fill(chunk.begin() + 6, chunk.end(), std::uint8_t{0x15});
  load(to_hex(chunk));
  advance_ms(10);
  log.take();
  for (int i = 0; i < 3; ++i)
    load("FE 00 20 00 00 1F");
  advance_ms(10);
  EXPECT_NE(log.take().find("marker 0A FE 2\n"), std::string::npos);
}

TEST_F(Executive, SleepForgetsUserMacros) {
  load("40 00 00");
  executive.fall_asleep(log.now);
  EXPECT_EQ(executive.start(0x40, log.now), MacroOutcome::NoSuchMacro);
}

TEST_F(Executive, TicksKeepTheirGridWhateverTheCallersSteps) {
  EXPECT_EQ(executive.save_temporary(*from_hex("FF 00 14 0A 00 00 00 0A 0B 00 0A 00"), log.now),
            MacroOutcome::Done);
  executive.start(255, log.now);
  for (int i = 1; i <= 40; ++i) {
    log.now += 300us;
    executive.advance_to(log.now);
  }
  EXPECT_FALSE(executive.running());
  EXPECT_TRUE(log.text.ends_with(" rgb 10 0 0\n")) << log.text;
}

RC_GTEST_PROP(ExecutiveProperty, AnyBytesRunWithoutHarm,
              (Bytes bytes, Bytes other, std::uint8_t flags)) {
  Log log;
  log.quiet = true;
  MacroExecutive executive(log);
  bytes.insert(bytes.begin(), {0x00, flags});
  other.insert(other.begin(), {0xFE, flags});
  if (spec::has_flag(flags, spec::MacroFlag::InhIfConn))
    log.client = false;
  if (bytes.size() <= spec::macro_max_packet) {
    executive.save_temporary(bytes, log.now);
    bytes[0] = 0x40;
    executive.save(bytes, log.now);
    executive.start(0x40, log.now);
    executive.advance_to(Instant{} + 500ms);
    executive.collide(log.now);
    executive.advance_to(Instant{} + 700ms);
    executive.abort(log.now);
    executive.start(0xFF, log.now);
    executive.advance_to(Instant{} + 1s);
    executive.reinitialize(log.now);
  }
  if (other.size() <= spec::macro_max_packet)
    for (int i = 0; i < 9; ++i) {
      executive.save(other, log.now);
      executive.advance_to(Instant{} + 1s + i * 20ms);
    }
}

} // namespace
} // namespace orb::vm
