#include "base/bytes.h"
#include "base/text/suggest.h"
#include "cli/commands/commands.h"
#include "cli/context/console.h"
#include "cli/model/checks.h"
#include "cli/model/command_line.h"
#include "disk/disk.h"
#include "reference/manual.h"

#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <string_view>
#include <unistd.h>

namespace orb::cli {
namespace {

struct ManOptions {
  std::string page = "orb";
  std::string folder;
};

std::string_view page_name(const reference::ManualPage& page) {
  return std::string_view(page.file).substr(0, page.file.rfind('.'));
}

/// Shows a page formatted by `man`; false if there is no `man`.
bool show_laid_out(const std::string& text) {
  auto* const reader = ::popen("man -l - 2>/dev/null", "w");
  if (reader == nullptr)
    return false;
  std::fwrite(text.data(), 1, text.size(), reader);
  return ::pclose(reader) == 0;
}

void print_page(Context& context, const std::vector<reference::ManualPage>& pages,
                const std::string& name) {
  std::vector<std::string_view> names;
  for (const auto& page : pages) {
    if (page_name(page) == name || page_name(page) == "orb-" + name) {
      if (is_terminal(Stream::Out) && show_laid_out(page.text))
        return;
      print_out(page.text);
      return;
    }
    names.push_back(page_name(page));
    if (names.back().starts_with("orb-"))
      names.push_back(names.back().substr(4));
  }
  fail(context,
       {ExitCode::Usage, fmt::format("unknown page `{}`; {}", name,
                                     did_you_mean(name, names, "`orb man orb` lists them"))});
}

void write_pages(Context& context, const std::vector<reference::ManualPage>& pages,
                 const std::string& folder) {
  for (const auto& page : pages) {
    const auto place = fmt::format("{}/man{}", folder, page.file.back());
    std::error_code error;
    // a failure shows when writing
    std::filesystem::create_directories(disk::as_path(place), error);
    if (const auto done = disk::write(place + "/" + page.file, as_bytes(page.text)); !done)
      return fail(context, {ExitCode::File, done.error().message});
  }
}

} // namespace

void add_man(const Command& orb, Context& context) {
  const auto command = orb.add_command("man", "print a page of the manual, or write all of them",
                                       "orb man run\n"
                                       "orb man orbbasic > orbbasic.7\n"
                                       "orb man --all man");
  auto options = std::make_shared<ManOptions>();
  const auto page =
      command.add_option("PAGE", options->page,
                         "a command, `orbbasic` or `orb-macro`; the page for orb itself "
                         "if none is given");
  command
      .add_option("--all", options->folder,
                  "write every page below this folder, laid out for `MANPATH`")
      .type_name("FOLDER")
      .excludes(page);
  command.callback([orb, &context, options] {
    const auto pages = reference::manual(as_data(orb));
    if (options->folder.empty())
      print_page(context, pages, options->page);
    else
      write_pages(context, pages, options->folder);
  });
}

} // namespace orb::cli
