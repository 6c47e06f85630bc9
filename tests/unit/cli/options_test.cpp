#include "cli/options.h"

#include "cli/commands.h"
#include "reference/completion_words.h"

#include <gtest/gtest.h>

namespace orb::cli {
namespace {

/// A small option model, so that the test does not depend on what the commands take today.
struct Model {
  CLI::App app{"", "tool"};
  std::vector<reference::Candidate> ports{{"@red", "rfcomm://68:86:E7:00:11:22"}};
  std::string text;
  std::vector<std::string> files;
  bool flag = false;

  Model() {
    app.add_flag("-q,--quiet", flag, "say less");
    auto* send = app.add_subcommand("send", "sends");
    send->add_option("FILE", files, "what to send")->required();
    send->add_option("--port", text, "where to");
    send->add_option("--format", text, "how")->check(one_of({"text", "json"}));
    send->add_option("--pty", text, "a link")->expected(0, 1);
    send->add_option("-n", text, "a number");
    auto* hidden = app.add_subcommand("secret", "for programs");
    hidden->group("");
    auto* explain = app.add_subcommand("explain", "explains");
    explain->add_option("WORD", text, "a word");
  }

  std::string answer(std::vector<std::string> words) {
    return print(complete(command_line(app), ports, words));
  }
};

TEST(Complete, OffersCommandsButNoHiddenOnes) {
  Model model;
  EXPECT_EQ(model.answer({""}), "send\tsends\nexplain\texplains\n");
  EXPECT_EQ(model.answer({"se"}), "send\tsends\n");
  EXPECT_EQ(model.answer({}), model.answer({""}));
  EXPECT_EQ(model.answer({"nonsense", ""}), "");
  EXPECT_EQ(model.answer({"secret", "--"}), "");
}

TEST(Complete, OffersOptionsOfTheCommandAndThoseThatStandAnywhere) {
  Model model;
  EXPECT_EQ(model.answer({"send", "--p"}), "--port\twhere to\n--pty\ta link\n");
  EXPECT_EQ(model.answer({"send", "--q"}), "--quiet\tsay less\n");
  EXPECT_EQ(model.answer({"-q", "se"}), "send\tsends\n");
}

TEST(Complete, OffersTheValuesOfAnOption) {
  Model model;
  EXPECT_EQ(model.answer({"send", "--format", ""}), "text\njson\n");
  EXPECT_EQ(model.answer({"send", "--format=j"}), "--format=json\n");
  EXPECT_EQ(model.answer({"send", "--port", "@"}), "@red\trfcomm://68:86:E7:00:11:22\n:files\n");
  EXPECT_EQ(model.answer({"send", "-n", ""}), "");
}

TEST(Complete, AnOptionalValueStandsOnlyBehindEquals) {
  Model model;
  EXPECT_EQ(model.answer({"send", "--pty", ""}), ":files\n"); // the argument FILE
  EXPECT_EQ(model.answer({"send", "--pty="}), ":files\n");
}

TEST(Complete, OffersWhatAnArgumentTakes) {
  Model model;
  EXPECT_EQ(model.answer({"send", "a.bas", ""}), ":files\n");
  EXPECT_EQ(model.answer({"send", "--", "--p"}), ":files\n");
  EXPECT_NE(model.answer({"explain", "gor"}).find("goroll\t"), std::string::npos);
  EXPECT_EQ(model.answer({"explain", "goroll", ""}), "");
}

TEST(OneOf, NamesTheWordThatWasMeant) {
  Model model;
  try {
    model.app.parse("send a.bas --format jsno");
    FAIL();
  } catch (const CLI::ValidationError& error) {
    EXPECT_EQ(std::string(error.what()),
              "--format: `jsno` is not one of text, json; did you mean `json`?");
  }
}

} // namespace
} // namespace orb::cli
