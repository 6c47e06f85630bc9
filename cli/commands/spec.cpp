#include "base/text/suggest.h"
#include "cli/commands/commands.h"
#include "cli/editors/word_lists.h"
#include "reference/knowledge.h"

#include <fmt/format.h>
#include <memory>

namespace orb::cli {
namespace {

struct SpecOptions {
  std::string section;
  bool json = false;
  bool markdown = false;
  bool cheatsheet = false;
  std::string editors; ///< folder to write the editors' word lists into
};

/// The list of sections with their contents: the output of plain `orb spec`.
std::string overview(const std::vector<reference::Section>& sections) {
  std::string out;
  for (const auto& section : sections)
    out += fmt::format("{:<16} {:>3} entries  {}\n", section.id, section.entries.size(),
                       section.title);
  return out;
}

std::string plain(const reference::Section& section, Style style) {
  std::string out;
  for (const auto& entry : section.entries)
    out += (out.empty() ? "" : "\n") + reference::print_entry(section, entry, style);
  return out;
}

/// Keeps only the section that the user named; false if it does not exist.
bool select_section(std::vector<reference::Section>& sections, const std::string& id,
                    const Context& context) {
  std::vector<std::string_view> ids;
  for (const auto& section : sections)
    ids.push_back(section.id);
  std::erase_if(sections, [&](const reference::Section& section) { return section.id != id; });
  if (!sections.empty())
    return true;
  print_error(context,
              fmt::format("unknown section `{}`; {}", id,
                          did_you_mean(id, ids, fmt::format("one of {}", fmt::join(ids, ", ")))));
  return false;
}

void print_spec(Context& context, const SpecOptions& options) {
  if (!options.editors.empty()) {
    write_editor_files(context, options.editors);
    return;
  }
  if (options.cheatsheet) {
    print_out(reference::print_cheatsheet());
    return;
  }
  const auto all = reference::knowledge();
  auto sections = all;
  const bool one = !options.section.empty();
  if (one && !select_section(sections, options.section, context)) {
    context.exit = ExitCode::Usage;
    return;
  }
  if (options.json)
    print_out(reference::print_json(sections));
  else if (options.markdown)
    for (const auto& section : sections)
      print_out(reference::print_markdown(all, section));
  else if (one)
    print_out(plain(sections.front(), context.out_style()));
  else {
    print_out(overview(sections));
    print_note(context, "`orb spec SECTION` prints one section, `orb explain WORD` one entry");
  }
}

} // namespace

void add_spec(const Command& orb, Context& context) {
  const auto command =
      orb.add_command("spec", "print the reference tables for the robot and the tools",
                      "orb spec\norb spec statements\norb spec --json > spec.json");
  auto options = std::make_shared<SpecOptions>();
  command.add_option("SECTION", options->section, "one table; all if none is given");
  const auto json = command.add_flag("--json", options->json, "as one JSON document");
  command.add_flag("--markdown", options->markdown, "as pages of docs/reference").excludes(json);
  command.add_flag("--cheatsheet", options->cheatsheet, "the language on one page").excludes(json);
  command
      .add_option("--editors", options->editors,
                  "write the grammars and syntax files for editors into this folder")
      .type_name("FOLDER")
      .excludes(json);
  command.callback([&context, options] { print_spec(context, *options); });
}

} // namespace orb::cli
