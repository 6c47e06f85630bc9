#include "cli/model/command_line.h"

#include "reference/completion_words.h"

#include <gtest/gtest.h>

namespace orb::cli {
namespace {

/// A small option model, so that the test does not depend on the real commands.
struct Parser {
  CommandLine line{"tool", "", ""};
  std::vector<reference::Candidate> ports{{"@red", "rfcomm://68:86:E7:00:11:22"}};
  std::string text;
  std::vector<std::string> files;
  bool flag = false;

  Parser() {
    const auto tool = line.root();
    tool.add_flag("-q,--quiet", flag, "say less");
    const auto send = tool.add_command("send", "sends", "tool send a.bas");
    send.add_option("FILE", files, "what to send").required();
    send.add_option("--port", text, "where to");
    send.add_option("--format", text, "how").check(one_of({"text", "json"}));
    send.add_option("--pty", text, "a link").value_optional();
    send.add_option("-n", text, "a number");
    tool.add_command("explain", "explains", "tool explain word").add_option("WORD", text, "a word");
  }

  std::string answer(std::vector<std::string> words) {
    return print(complete(as_data(line.root()), ports, words));
  }
};

TEST(Complete, OffersCommands) {
  Parser model;
  EXPECT_EQ(model.answer({""}), "send\tsends\nexplain\texplains\n");
  EXPECT_EQ(model.answer({"se"}), "send\tsends\n");
  EXPECT_EQ(model.answer({}), model.answer({""}));
  EXPECT_EQ(model.answer({"nonsense", ""}), "");
}

TEST(Complete, OffersOptionsOfTheCommandAndThoseThatStandAnywhere) {
  Parser model;
  EXPECT_EQ(model.answer({"send", "--p"}), "--port\twhere to\n--pty\ta link\n");
  EXPECT_EQ(model.answer({"send", "--q"}), "--quiet\tsay less\n");
  EXPECT_EQ(model.answer({"-q", "se"}), "send\tsends\n");
}

TEST(Complete, OffersTheValuesOfAnOption) {
  Parser model;
  EXPECT_EQ(model.answer({"send", "--format", ""}), "text\njson\n");
  EXPECT_EQ(model.answer({"send", "--format=j"}), "--format=json\n");
  EXPECT_EQ(model.answer({"send", "--port", "@"}), "@red\trfcomm://68:86:E7:00:11:22\n:files\n");
  EXPECT_EQ(model.answer({"send", "-n", ""}), "");
}

TEST(Complete, AnOptionalValueStandsOnlyBehindEquals) {
  Parser model;
  EXPECT_EQ(model.answer({"send", "--pty", ""}), ":files\n"); // the argument FILE
  EXPECT_EQ(model.answer({"send", "--pty="}), ":files\n");
}

TEST(Complete, OffersWhatAnArgumentTakes) {
  Parser model;
  EXPECT_EQ(model.answer({"send", "a.bas", ""}), ":files\n");
  EXPECT_EQ(model.answer({"send", "--", "--p"}), ":files\n");
  EXPECT_NE(model.answer({"explain", "gor"}).find("goroll\t"), std::string::npos);
  EXPECT_EQ(model.answer({"explain", "goroll", ""}), "");
}

TEST(OneOf, NamesTheWordThatWasMeant) {
  Parser model;
  const auto parsed = model.line.parse({"send", "a.bas", "--format", "jsno"});
  EXPECT_EQ(parsed.kind, Parsed::Kind::Misread);
  EXPECT_EQ(parsed.command, "send");
  EXPECT_EQ(parsed.text, "--format: `jsno` is not one of text, json; did you mean `json`?");
}

} // namespace
} // namespace orb::cli
