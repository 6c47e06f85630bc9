#include "assembler/assemble.h"

#include "assembler/disassemble.h"
#include "assembler/lint/lint.h"
#include "assembler/text/rules.h"
#include "assembler/timing.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace orb::assembler {
namespace {

Assembly assembled(const std::string& text, Folding folding = Folding::Keep) {
  return assemble(Source("test.macro", text), folding);
}

std::string body_of(const std::string& text) {
  const auto assembly = assembled(text);
  EXPECT_FALSE(assembly.has_errors()) << text << in_english(assembly.diagnostics[0].message);
  return to_hex(assembly.macros.at(0).body);
}

bool raises(const std::string& text, std::string_view rule) {
  for (const auto& diagnostic : check(Source("test.macro", text)))
    if (diagnostic.rule->id == rule)
      return true;
  return false;
}

TEST(Rules, EachBadSourceRaisesItsRuleAndTheGoodOneDoesNot) {
  for (const auto& rule : rules::all()) {
    if (rule.bad.empty())
      continue;
    EXPECT_TRUE(raises(std::string(rule.bad), rule.id)) << rule.id;
    EXPECT_FALSE(raises(std::string(rule.good), rule.id)) << rule.id;
    EXPECT_FALSE(assembled(std::string(rule.good)).has_errors()) << rule.id;
  }
}

TEST(Assemble, EachExampleOfTheTableIsItsCommand) {
  for (const auto& info : spec::macro_commands) {
    const auto assembly = assembled(std::string(info.example));
    ASSERT_FALSE(assembly.has_errors()) << info.example;
    EXPECT_EQ(assembly.macros[0].commands[0].info, &info) << info.example;
  }
}

TEST(Assemble, OperandsGoByPositionOrByName) {
  EXPECT_EQ(body_of("roll 127, 291, 119"), "05 7F 01 23 77 00");
  EXPECT_EQ(body_of("roll delay=119ms heading=291deg speed=0x7F"), "05 7F 01 23 77 00");
  EXPECT_EQ(body_of("roll 127 291 delay=119"), "05 7F 01 23 77 00");
  EXPECT_EQ(body_of("rotate -720deg, 5s"), "1A FD 30 13 88 00");
  EXPECT_EQ(body_of("configure_collision 1 2 3 4 5 dead_time=60ms"), "27 01 02 03 04 05 06 00");
}

TEST(Assemble, LinesMayEndAsTheyLike) {
  EXPECT_EQ(body_of("marker 20\r\nmarker 21\rmarker 22"), "15 14 15 15 15 16 00");
  EXPECT_EQ(body_of("  marker 20 ; a\n\n# b\n\t marker\t21#c"), "15 14 15 15 00");
}

TEST(Assemble, AnEndIsAddedWhereThereIsNone) {
  EXPECT_EQ(body_of("marker 20\nend\n"), "15 14 00");
  EXPECT_EQ(body_of("marker 20\n.noend\n"), "15 14");
}

TEST(Assemble, EveryFlagHasItsWord) {
  for (const auto& flag : spec::macro_flags) {
    const auto assembly = assembled(fmt::format(".macro a id=40 flags={}\nmarker 20\n", flag.word));
    ASSERT_FALSE(assembly.has_errors()) << flag.word;
    EXPECT_EQ(assembly.macros[0].image().flags, flag.bit);
    EXPECT_EQ(assembly.macros[0].extended_flags.has_value(),
              flag.flag == spec::MacroFlag::ExtFlags);
  }
}

TEST(Assemble, AMacroWithoutAHeaderIsTemporaryWithTheDefaultFlags) {
  const auto assembly = assembled("marker 20\n");
  EXPECT_EQ(to_hex(protocol::encode(assembly.macros[0].image())), "FF 01 15 14 00");
}

TEST(Assemble, AtMostOneSyntaxErrorALineAndAllLines) {
  const auto assembly = assembled("roll :: 1\nrol 1\nmarker 20\nrgb ,,\n");
  EXPECT_EQ(assembly.diagnostics.size(), 3U);
}

TEST(Disassemble, EveryCommandComesBackByName) {
  for (const auto& info : spec::macro_commands) {
    const auto assembly = assembled(std::string(info.example));
    const auto text = disassemble(assembly.macros[0].body, Reading::Headerless);
    ASSERT_TRUE(text);
    EXPECT_TRUE(text->starts_with(info.mnemonic)) << *text;
  }
}

// A complete macro: commands with random operands and one End.
Bytes random_body() {
  Bytes body;
  const auto count = *rc::gen::inRange(0, 30);
  for (int i = 0; i < count; ++i) {
    const auto& info = *rc::gen::elementOf(std::vector<spec::MacroCommandInfo>(
        std::next(std::begin(spec::macro_commands)), std::end(spec::macro_commands)));
    std::vector<std::int32_t> values;
    std::string text;
    for (const auto& operand : info) {
      if (operand.kind == spec::MacroOperandKind::Text)
        text = *rc::gen::resize(20, rc::gen::arbitrary<std::string>());
      else if (*rc::gen::inRange(0, 8) == 0)
        values.push_back(*rc::gen::inRange(0, 65536));
      else
        values.push_back(*rc::gen::inRange(operand.minimum, operand.maximum + 1));
    }
    protocol::append_macro_command(body, info.command, values, text);
  }
  body.push_back(spec::info(spec::MacroCommand::End).code);
  return body;
}

RC_GTEST_PROP(RoundTrip, HeaderlessBytesComeBack, ()) {
  const auto body = random_body();
  const auto text = disassemble(body, Reading::Headerless);
  RC_ASSERT(text.has_value());
  const auto assembly = assembled(*text);
  RC_ASSERT(!assembly.has_errors());
  RC_ASSERT(assembly.macros.size() == 1U);
  RC_ASSERT(assembly.macros[0].body == body);
}

RC_GTEST_PROP(RoundTrip, FramedBytesComeBack, ()) {
  auto image =
      protocol::MacroImage{*rc::gen::inRange<std::uint8_t>(1, 255),
                           *rc::gen::arbitrary<std::uint8_t>(), std::nullopt, random_body()};
  if (*rc::gen::arbitrary<bool>())
    image.body.pop_back();
  if (image.body.empty())
    image.body.push_back(0);
  if (spec::has_flag(image.flags, spec::MacroFlag::ExtFlags))
    image.extended_flags = *rc::gen::arbitrary<std::uint8_t>();
  const auto bytes = protocol::encode(image);
  const auto text = disassemble(bytes, Reading::Framed);
  RC_ASSERT(text.has_value());
  const auto assembly = assembled(*text);
  RC_ASSERT(!assembly.has_errors());
  RC_ASSERT(protocol::encode(assembly.macros[0].image()) == bytes);
}

RC_GTEST_PROP(RoundTrip, AnyBytesDisassembleOrSayWhyNot, (const Bytes& bytes)) {
  for (const auto reading : {Reading::Headerless, Reading::Framed}) {
    const auto text = disassemble(bytes, reading);
    if (!text)
      RC_ASSERT(text.error().starts_with("offset "));
    else
      RC_ASSERT(!assembled(*text).has_errors());
  }
}

RC_GTEST_PROP(Source, AnyTextIsAssembledOrExplained, (const std::string& text)) {
  const auto assembly = assembled(text);
  RC_ASSERT(assembly.has_errors() || !assembly.macros.empty());
  check(orb::Source("test.macro", text));
}

RC_GTEST_PROP(Fold, FoldingKeepsTheTimesAndNeverGrows, ()) {
  std::string text;
  const auto lines = *rc::gen::inRange(1, 20);
  for (int i = 0; i < lines; ++i)
    switch (*rc::gen::inRange(0, 5)) {
    case 0: text += fmt::format("roll 1, 2, {}\n", *rc::gen::inRange(0, 600)); break;
    case 1: text += fmt::format("rgb 1, 2, 3, {}\n", *rc::gen::inRange(0, 256)); break;
    case 2: text += "marker 20\n"; break;
    default: text += fmt::format("delay {}\n", *rc::gen::inRange(0, 300));
    }
  const auto kept = assembled(text);
  const auto folded = assembled(text, Folding::Fold);
  RC_ASSERT(folded.macros[0].body.size() <= kept.macros[0].body.size());
  RC_ASSERT(time_macro(folded, 0).most_ms == time_macro(kept, 0).most_ms);
  // Every command other than a delay begins at the same time as before.
  std::vector<std::pair<std::uint8_t, std::int64_t>> times[2];
  for (const auto* assembly : {&kept, &folded}) {
    const auto timing = time_macro(*assembly, 0);
    for (std::size_t i = 0; i < timing.commands.size(); ++i) {
      const auto& command = assembly->macros[0].commands[i];
      const auto roll = command.info->command == spec::MacroCommand::Roll2;
      if (command.info->command != spec::MacroCommand::Delay)
        times[assembly == &folded].emplace_back(roll ? spec::info(spec::MacroCommand::Roll).code
                                                     : command.info->code,
                                                timing.commands[i]->begins_ms);
    }
  }
  RC_ASSERT(times[0] == times[1]);
}

TEST(Timing, LoopsAndSubroutinesCount) {
  const auto assembly = assembled(".macro a id=40\nset_sd1 30\nloop_start 3\nroll_sd1 1, 2\ngosub "
                                  "b\nloop_end\nwait_until_stopped 1s\n.macro b id=41\ndelay 5\n");
  const auto timing = time_macro(assembly, 0);
  EXPECT_EQ(timing.least_ms, 105);
  EXPECT_EQ(timing.most_ms, 1105);
  EXPECT_EQ(to_string(timing), "105 ms to 1.105 s, depending on when the ball stops");
  EXPECT_EQ(timing.commands[2]->times, 3U);
}

TEST(Timing, AMacroThatComesBackIsEndless) {
  EXPECT_EQ(time_macro(assembled("delay 5\ngoto 255\n"), 0).note, TimingNote::Endless);
  EXPECT_EQ(time_macro(assembled("delay 5\ngoto 77\n"), 0).note, TimingNote::Leaves);
}

TEST(Lint, FilesLeadToEachOtherAndTheMacrosOfOneShareTheHeap) {
  const Source a("a.macro", ".macro a id=40\ngoto 41\n");
  const Source b("b.macro", ".macro b id=41\nmarker 20\n");
  const Source c("c.macro", ".macro c id=41\nmarker 20\n");
  const Source* two[] = {&a, &b};
  for (const auto& file : check(two))
    EXPECT_TRUE(file.diagnostics.empty()) << file.source->name();
  const Source* three[] = {&a, &b, &c};
  for (const auto& file : check(three)) // each may be for another ball
    EXPECT_TRUE(file.diagnostics.empty()) << file.source->name();
  std::string many;
  for (int id = 32; id < 49; ++id)
    many += fmt::format(".macro m{} id={}\nmarker 20\n", id, id);
  EXPECT_TRUE(raises(many, "macro-heap-full"));
  std::string large;
  for (int id = 32; id < 41; ++id) {
    large += fmt::format(".macro m{} id={}\n", id, id);
    for (int i = 0; i < 120; ++i)
      large += "marker 20\n";
  }
  EXPECT_TRUE(raises(large, "macro-heap-full"));
}

TEST(Lint, NewerCommandsThanTheExecutiveAreErrors) {
  const Source source("a.macro", "roll2 1, 2, 3\nloop_start_system\nloop_end\n");
  const auto count = [&](int version) {
    int errors = 0;
    for (const auto& diagnostic : check(source, {version}))
      errors += diagnostic.rule->id == "macro-executive" ? 1 : 0;
    return errors;
  };
  EXPECT_EQ(count(4), 0);
  EXPECT_EQ(count(3), 1);
  EXPECT_EQ(count(2), 3);
}

TEST(Lint, ASizeThatNoPacketCarries) {
  const auto source = [](int markers, std::string_view header) {
    auto text = std::string(header) + "\n";
    for (int i = 0; i < markers; ++i)
      text += "marker 20\n";
    return text;
  };
  EXPECT_FALSE(raises(source(125, ".macro a id=40"), "macro-too-large"));
  EXPECT_TRUE(raises(source(126, ".macro a id=40"), "macro-too-large"));
  EXPECT_TRUE(raises(source(126, ""), "macro-needs-chunks"));
  EXPECT_FALSE(raises(source(510, ".macro a id=255"), "macro-too-large"));
  EXPECT_TRUE(raises(source(511, ".macro a id=255"), "macro-too-large"));
  EXPECT_TRUE(raises(source(511, ""), "macro-needs-stream"));
  EXPECT_FALSE(raises(source(511, ".macro a id=254"), "macro-too-large"));
}

} // namespace
} // namespace orb::assembler
