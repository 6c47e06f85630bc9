#include "base/text/text.h"
#include "reference/sections.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

// The pages of docs/reference/. Each begins with a table; words that another page explains link to
// it.

namespace orb::reference {

std::string table_cell(std::string_view text) {
  std::string out;
  for (const char c : text)
    out += c == '|' ? std::string("\\|") : c == '\n' ? std::string("<br>") : std::string(1, c);
  return out;
}

namespace {

/// The captions in the entries of a section, in order of first appearance.
std::vector<std::string> captions(const Section& section) {
  std::vector<std::string> names;
  for (const auto& entry : section.entries)
    for (const auto& fact : entry.facts)
      if (std::find(names.begin(), names.end(), fact.first) == names.end())
        names.push_back(fact.first);
  return names;
}

/// True if all entries have the same kinds of facts; otherwise they become chapters.
bool fits_table(const Section& section) {
  const auto plain = [](const Entry& entry) {
    return entry.explanation.empty() && entry.code.empty();
  };
  return captions(section).size() <= 5 &&
         std::all_of(section.entries.begin(), section.entries.end(), plain);
}

/// The link target of a heading, as forges derive it from the text.
std::string anchor(std::string_view heading) {
  std::string out;
  for (const char c : heading) {
    if (is_letter(c) || is_digit(c) || c == '-' || c == '_')
      out += to_lower(c);
    else if (c == ' ')
      out += '-';
  }
  return out;
}

/// The same for an entry; a duplicate heading gets a number.
std::string anchor(const Section& section, const Entry& entry) {
  const auto own = anchor(entry.name);
  int earlier = 0;
  for (const auto& other : section.entries) {
    if (&other == &entry)
      break;
    earlier += anchor(other.name) == own ? 1 : 0;
  }
  return earlier == 0 ? own : fmt::format("{}-{}", own, earlier);
}

/// Link targets of all words; computed once per page.
class Links {
public:
  /// For links on the page `here`.
  Links(const std::vector<Section>& sections, const Section& here) {
    // Words of these pages mean something else in running text.
    const auto is_alone = [](const Section& section) { return section.id == "colours"; };
    // A word of several languages links to the page's own language. Only pages about structured
    // programs and tests link to their words: elsewhere `sub` and `end` have another meaning.
    const auto own = language_of(here);
    for (const bool own_language : {true, false})
      for (const auto& section : sections)
        if ((language_of(section) == own) == own_language && !is_alone(section) &&
            (own_language || (language_of(section) != Language::Structured &&
                              language_of(section) != Language::Test)))
          add(section, here);
  }

  /// Adds links to running text: words in backticks that have an entry, and decisions (A-17). `own`
  /// is the entry that the text belongs to.
  std::string text(std::string_view plain, std::string_view own) const {
    std::string out;
    for (std::size_t at = 0; at < plain.size();) {
      if (plain[at] == '`') {
        const auto end = std::min(plain.find('`', at + 1), plain.size());
        const auto word = plain.substr(at + 1, end - at - 1);
        const auto place = places_.find(word);
        const auto code = plain.substr(at, end + 1 - at);
        out += place == places_.end() || word == own ? std::string(code)
                                                     : fmt::format("[{}]({})", code, place->second);
        at = end + 1;
      } else if (const auto decision = decision_at(plain, at); !decision.empty()) {
        out += fmt::format("[{}](decisions.md#{})", decision,
                           decision.front() == 'A' ? "orbbasic" : "macros");
        at += decision.size();
      } else {
        out += plain[at++];
      }
    }
    return out;
  }

private:
  enum class Language { Basic, Structured, Macro, Test };
  static Language language_of(const Section& section) {
    return section.id.starts_with("macro")        ? Language::Macro
           : section.id.starts_with("structured") ? Language::Structured
           : section.id.starts_with("stimul") || section.id.starts_with("test-") ||
                   section.id == "expectations"
               ? Language::Test
               : Language::Basic;
  }

  void add(const Section& section, const Section& here) {
    const auto page = section.id == here.id ? std::string() : fmt::format("{}.md", section.id);
    for (const auto& entry : section.entries) {
      const auto place = fits_table(section) ? page : page + "#" + anchor(section, entry);
      if (!place.empty())
        places_.try_emplace(entry.name, place);
    }
  }

  /// The decision at `at`, `A-17` or `M-2`; empty if there is none.
  static std::string_view decision_at(std::string_view text, std::size_t at) {
    const bool starts = (text[at] == 'A' || text[at] == 'M') && text.substr(at + 1, 1) == "-" &&
                        (at == 0 || text[at - 1] == ' ' || text[at - 1] == '(');
    auto end = at + 2;
    while (starts && end < text.size() && is_digit(text[end]))
      ++end;
    return starts && end > at + 2 ? text.substr(at, end - at) : std::string_view();
  }

  std::map<std::string, std::string, std::less<>> places_;
};

/// A fact with its links; a source links to the document behind its key.
std::string fact_text(const Links& links, std::string_view own,
                      const std::pair<std::string, std::string>& fact) {
  const auto text = links.text(fact.second, own);
  const auto key = text.substr(0, text.find_first_of(" ,;"));
  return fact.first == "source" && !key.empty() && key.front() != '['
             ? fmt::format("[{}](../../spec/SOURCES.md){}", key, text.substr(key.size()))
             : text;
}

/// A section as one table.
std::string table(const Section& section, const Links& links) {
  const auto names = captions(section);
  auto out = fmt::format("| {} |", section.kind);
  for (const auto& name : names)
    out += fmt::format(" {} |", name);
  out += " what it is |\n|---|";
  for (std::size_t i = 0; i < names.size(); ++i)
    out += "---|";
  out += "---|\n";
  for (const auto& entry : section.entries) {
    out += fmt::format("| `{}` |", table_cell(entry.name));
    for (const auto& name : names) {
      const auto fact = std::find_if(entry.facts.begin(), entry.facts.end(),
                                     [&](const auto& f) { return f.first == name; });
      out += fmt::format(" {} |", fact == entry.facts.end()
                                      ? ""
                                      : table_cell(fact_text(links, entry.name, *fact)));
    }
    out += fmt::format(" {} |\n", table_cell(links.text(entry.summary, entry.name)));
  }
  return out;
}

/// The table before the chapters: each entry with its short facts and its summary.
std::string contents(const Section& section, const Links& links) {
  constexpr std::size_t most = 12; // characters; leaves space for the summary
  auto names = captions(section);
  std::erase_if(names, [&](const std::string& name) {
    return !std::all_of(section.entries.begin(), section.entries.end(), [&](const Entry& entry) {
      return std::any_of(entry.facts.begin(), entry.facts.end(), [&](const auto& fact) {
        return fact.first == name && fact.second.size() <= most;
      });
    });
  });
  Section short_one{section.id, section.title, section.kind, {}};
  for (const auto& entry : section.entries) {
    short_one.entries.push_back({entry.name, {}, entry.summary, {}, {}, {}});
    for (const auto& fact : entry.facts)
      if (std::find(names.begin(), names.end(), fact.first) != names.end())
        short_one.entries.back().facts.push_back(fact);
  }
  auto out = table(short_one, links) + "\n";
  for (const auto& entry : section.entries) {
    const auto plain = fmt::format("\n| `{}` |", table_cell(entry.name));
    if (const auto at = out.find(plain); at != std::string::npos)
      out.replace(at, plain.size(),
                  fmt::format("\n| [`{}`](#{}) |", table_cell(entry.name), anchor(section, entry)));
  }
  return out;
}

/// The language of a code block (tests/docs/page.h). A bad example or a fragment is plain text.
std::string_view fence(std::string_view section, std::string_view caption) {
  if (caption == "bad" || section.starts_with("test-") || section == "statements" ||
      section.starts_with("client-") || section == "words" || section == "functions")
    return "text";
  if (section.starts_with("api-"))
    return "sh";
  if (section.starts_with("macro-"))
    return "macro";
  if (section.starts_with("structured-"))
    return "orb";
  if (section.starts_with("course-"))
    return "svg";
  return section.starts_with("stimulus-") ? "stimulus" : "basic";
}

std::string chapter(std::string_view section, const Entry& entry, const Links& links) {
  auto out = fmt::format("## `{}`\n\n{}\n\n", entry.name, links.text(entry.summary, entry.name));
  for (const auto& fact : entry.facts)
    out += fmt::format("- {}: {}\n", fact.first, fact_text(links, entry.name, fact));
  if (!entry.facts.empty())
    out += "\n";
  if (!entry.explanation.empty())
    out += fmt::format("{}\n\n", links.text(entry.explanation, entry.name));
  for (const auto& [caption, source] : entry.code)
    out += fmt::format("{}:\n\n```{}\n{}\n```\n\n", caption, fence(section, caption),
                       source.ends_with("\n") ? source.substr(0, source.size() - 1) : source);
  return out;
}

} // namespace

std::string print_markdown(const std::vector<Section>& sections, const Section& section) {
  const Links links(sections, section);
  auto out = fmt::format("<!-- Printed by `orb spec --markdown {}`; a test compares them. -->\n"
                         "# {}\n\n",
                         section.id, section.title);
  if (fits_table(section))
    return out + table(section, links);
  if (!section.overview.empty())
    out += section.overview + "\n";
  out += contents(section, links);
  for (const auto& entry : section.entries)
    out += chapter(section.id, entry, links);
  out.pop_back(); // end the file with a single line break
  return out;
}

} // namespace orb::reference
