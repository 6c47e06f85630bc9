#include "testing/verdicts/pupils.h"

#include "base/text/text.h"
#include "testing/texts.h"

#include <fmt/format.h>

namespace orb::testing {
namespace {

constexpr std::string_view page_style = R"css(
:root{color-scheme:light dark;--ink:#14212b;--paper:#fff;--card:#f3f7f9;--good:#1a7f37;--bad:#b3261e;--dim:#536472}
@media (prefers-color-scheme:dark){:root{--ink:#e4ecf1;--paper:#0b1014;--card:#161f27;--good:#4fc46b;--bad:#ff8a7f;--dim:#91a2af}}
body{font:16px/1.5 system-ui,sans-serif;color:var(--ink);background:var(--paper);margin:2rem auto;max-width:46rem;padding:0 1rem;overflow-wrap:anywhere}
h1{font-size:1.6rem;margin:0}.points{font-size:1.2rem;margin:.2rem 0 1.5rem}
section{background:var(--card);border-radius:.6rem;border-left:.3rem solid var(--good);padding:.8rem 1rem;margin:1rem 0;break-inside:avoid}
section.failed,section.error{border-left-color:var(--bad)}h2{font-size:1.05rem;margin:0}
section img{width:16rem;max-width:100%;height:auto;display:block;border-radius:.4rem;margin:.6rem 0}
.sign{color:var(--good)}.failed .sign,.error .sign{color:var(--bad)}.dim{color:var(--dim)}p{margin:.4rem 0 0}
code,pre{font-size:.85em}pre{white-space:pre-wrap;margin:.4rem 0 0}a{color:inherit}
)css";

constexpr std::string_view sheet_style = R"css(
@page{size:A4 landscape;margin:0}
body{font:18px/1.5 system-ui,sans-serif;color:#14212b;background:#dfe7ec;margin:0}
section{box-sizing:border-box;width:297mm;height:209mm;max-width:100%;margin:1rem auto;padding:16mm;background:#fff;break-after:page;break-inside:avoid}
.frame{box-sizing:border-box;height:100%;border:1.5mm solid #1a7f37;outline:.4mm solid #1a7f37;outline-offset:2mm;border-radius:4mm;padding:12mm;text-align:center;display:flex;flex-direction:column;justify-content:center;gap:4mm}
h1{font-size:15mm;letter-spacing:1mm;margin:0;line-height:1.1}.name{font-size:13mm;font-weight:700;line-height:1.1;margin:0;overflow-wrap:anywhere}
p{margin:0;font-size:6mm}ul{list-style:none;margin:0;padding:0;font-size:5mm}.sign{color:#1a7f37}
.sheet-foot{display:flex;justify-content:space-around;margin-top:14mm}.sheet-foot span{border-top:.3mm solid #14212b;width:70mm;padding-top:1mm;font-size:4mm}
@media print{body{background:none}section{margin:0}}
@media (max-width:60rem){section{height:auto}}
)css";

// Fits on a sheet below a long name.
constexpr std::size_t most_on_sheet = 8;

/// A drawing as a data URL, so that the page needs no other file.
std::string inside(std::string_view svg) {
  std::string out = "data:image/svg+xml,";
  for (const char c : svg)
    if (std::string_view("%#\"<>&'\n").find(c) == std::string_view::npos)
      out += c;
    else
      out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return out;
}

std::string head(std::string_view title, std::string_view style, const Speech& speech) {
  return fmt::format("<!doctype html>\n<html lang=\"{}\"><head><meta charset=\"utf-8\">"
                     "<meta name=\"viewport\" content=\"width=device-width\"><title>{}</title>"
                     "<style>{}</style></head>\n<body>\n",
                     speech.code, escape_markup(title), style);
}

std::string misses(const CaseResult& one, const Speech& speech) {
  std::string out;
  for (const auto& miss : one.misses)
    out += fmt::format("<p><code>{}</code><br><span class=\"dim\">{}</span></p>\n",
                       escape_markup(miss.expected), escape_markup(speech.say(miss.seen)));
  if (!one.problem.empty())
    out += fmt::format("<pre>{}</pre>\n", escape_markup(one.problem));
  return out;
}

} // namespace

std::string pupil_page(std::string_view name, const Table::Row& row,
                       const std::map<const GroupResult*, Shown>& shown, const Speech& speech) {
  const auto say = [&](const Message& message) { return escape_markup(speech.say(message)); };
  auto out = head(name, page_style, speech) +
             fmt::format("<h1>{}</h1>\n<p class=\"points\">{}</p>\n", escape_markup(name),
                         say(texts::PointsOf(row.points, row.points_of)));
  std::string told; // a program that cannot run fails every test with the same words
  for (const auto* cell : row.cells) {
    if (cell == nullptr || cell->cases.empty())
      continue;
    const bool passed = cell->verdict() == Verdict::Passed;
    out += fmt::format(
        "<section class=\"{}\"><h2><span class=\"sign\">{}</span> {} <span class=\"dim\">{}</span>"
        "</h2>\n",
        to_string(cell->verdict()), passed ? "✓" : "✗", say(Message::as_is(cell->test)),
        say(texts::PointsOf(passed ? cell->points : 0, cell->points)));
    if (const auto at = shown.find(cell); at != shown.end()) {
      const auto& [picture, replay] = at->second;
      const auto image =
          fmt::format("<img src=\"{}\" alt=\"{}\">", inside(picture), say(texts::PathOfBall()));
      out +=
          replay.empty() ? image + "\n" : fmt::format("<a href=\"../{}\">{}</a>\n", replay, image);
    }
    if (const auto* failure = first_failure(*cell);
        failure != nullptr && (failure->problem.empty() || failure->problem != told)) {
      out += misses(*failure, speech);
      told = failure->problem;
    }
    out += "</section>\n";
  }
  return out + "</body></html>\n";
}

std::string certificates(const std::vector<std::string>& names, const Table& table,
                         const Speech& speech) {
  const auto say = [&](const Message& message) { return escape_markup(speech.say(message)); };
  std::string done;
  for (std::size_t i = 0; i < std::min(table.tests.size(), most_on_sheet); ++i)
    done += fmt::format("<li><span class=\"sign\">✓</span> {}</li>",
                        say(Message::as_is(table.tests[i])));
  if (table.tests.size() > most_on_sheet)
    done += "<li>…</li>";
  auto out = head(speech.say(texts::Certificates()), sheet_style, speech);
  for (const auto& name : names)
    out += fmt::format(
        "<section><div class=\"frame\"><h1>{}</h1>\n<p class=\"name\">{}</p>\n<p>{}</p>\n"
        "<ul>{}</ul>\n<div class=\"sheet-foot\"><span>{}</span><span>{}</span></div></div>"
        "</section>\n",
        say(texts::Certificate()), escape_markup(name), say(texts::HasPassed()), done,
        say(texts::Date()), say(texts::Signature()));
  return out + "</body></html>\n";
}

} // namespace orb::testing
