#include "cli/commands/commands.h"
#include "cli/model/checks.h"

#include <array>
#include <memory>
#include <string_view>

namespace orb::cli {
namespace {

// Each script asks `orb __complete -- WORDS`. The answer comes from the option model: one candidate
// per line, a tab, its summary; and a line `:files` where file names fit. The scripts only adapt
// this to their shell; they know no commands, options or values.

// Bash splits words at `=` and `:`. The script takes whole words from the typed line and removes
// what precedes the last split from each candidate: bash replaces only the rest.
constexpr std::string_view bash_script =
    R"SH(# bash completion for orb: eval "$(orb completion bash)"
_orb() {
  local line=${COMP_LINE:0:COMP_POINT} current files= word
  local -a words
  read -ra words <<<"$line"
  case $line in *[[:blank:]]) words+=("") ;; esac
  current=${words[${#words[@]}-1]}
  COMPREPLY=()
  local cut=
  case $current in
    *[=:]*) cut=${current%"${current##*[=:]}"} ;;
  esac
  while IFS=$'\t' read -r word _; do
    if [ "$word" = :files ]; then
      files=1
    else
      COMPREPLY+=("${word#"$cut"}")
    fi
  done < <("$1" __complete -- "${words[@]:1}" 2>/dev/null)
  if [ "${#COMPREPLY[@]}" -gt 0 ]; then
    case ${COMPREPLY[0]} in *: | *//) compopt -o nospace 2>/dev/null ;; esac
  fi
  if [ -n "$files" ]; then
    compopt -o filenames 2>/dev/null
    while IFS= read -r word; do COMPREPLY+=("$word"); done < <(compgen -f -- "${current##*=}")
  fi
}
complete -F _orb orb
)SH";

constexpr std::string_view zsh_script = R"SH(#compdef orb
# zsh completion for orb: eval "$(orb completion zsh)", or a file _orb in a folder of $fpath
_orb() {
  local line word summary files=
  local -a found shown open_found open_shown
  while IFS=$'\t' read -r word summary; do
    if [[ $word == :files ]]; then
      files=1
    elif [[ $word == *: || $word == *// ]]; then
      open_found+=("$word") open_shown+=("${word}${summary:+  -- $summary}")
    else
      found+=("$word") shown+=("${word}${summary:+  -- $summary}")
    fi
  done < <(${(Q)words[1]} __complete -- "${(@Q)words[2,CURRENT]}" 2>/dev/null)
  (( $#found )) && compadd -l -d shown -- "${found[@]}"
  (( $#open_found )) && compadd -S '' -l -d open_shown -- "${open_found[@]}"
  if [[ -n $files ]]; then
    compset -P '*='
    _files
  fi
}
if [[ $funcstack[1] == _orb ]]; then
  _orb "$@"
else
  compdef _orb orb
fi
)SH";

constexpr std::string_view fish_script =
    R"SH(# fish completion for orb: orb completion fish | source
function __orb_complete
    set -l words (commandline -opc) (commandline -ct)
    set -l files
    for line in ($words[1] __complete -- $words[2..-1] 2>/dev/null)
        if test "$line" = :files
            set files 1
        else
            echo $line
        end
    end
    if test -n "$files"
        set -l current (commandline -ct)
        set -l before (string match -r -- '^-[^=]*=' $current)
        __fish_complete_path (string replace -r -- '^-[^=]*=' '' $current) | string replace -r -- '^' "$before"
    end
end
complete -c orb -f -a '(__orb_complete)'
)SH";

struct Shell {
  std::string_view name;
  std::string_view script;
};

constexpr std::array<Shell, 3> shells = {
    {{"bash", bash_script}, {"zsh", zsh_script}, {"fish", fish_script}}};

} // namespace

void add_completion(const Command& orb, Context&) {
  const auto command = orb.add_command("completion", "print a completion script for a shell",
                                       "eval \"$(orb completion bash)\"\n"
                                       "orb completion zsh > ~/.zfunc/_orb\n"
                                       "orb completion fish > ~/.config/fish/completions/orb.fish");
  std::vector<std::string> names;
  for (const auto& shell : shells)
    names.emplace_back(shell.name);
  auto name = std::make_shared<std::string>();
  command.add_option("SHELL", *name, "the shell to print a script for")
      .required()
      .check(one_of(names));
  command.callback([name] {
    for (const auto& shell : shells)
      if (shell.name == *name)
        print_out(shell.script);
  });
}

} // namespace orb::cli
