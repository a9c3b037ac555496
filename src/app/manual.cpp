#include "app/manual.hpp"

#include <fmt/format.h>

#include <sstream>

#include "run/version.hpp"

namespace chute::app {
namespace {

/// Text as troff prints it unchanged: a backslash and a leading dot or quote would be its commands, and a bare
/// hyphen may come out as a dash that nobody can copy into a shell.
std::string plain(const std::string& text) {
  std::string result;
  bool line_begins = true;
  for (const char c : text) {
    if (line_begins && (c == '.' || c == '\'')) result += "\\&";
    line_begins = c == '\n';
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
  }
  return result;
}

std::vector<const CLI::Option*> shown_options(const CLI::App& verb) {
  return verb.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

std::vector<const CLI::App*> shown_verbs(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* verb) { return !verb->get_group().empty(); });
}

void add_options(std::string& page, const CLI::App& verb) {
  const CLI::Formatter words;  // the one that writes --help
  for (const auto* option : shown_options(verb)) {
    const bool positional = option->get_positional();
    page += fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", plain(words.make_option_name(option, positional)),
                        plain(words.make_option_opts(option)), plain(words.make_option_desc(option)));
  }
}

/// "[OPTIONS] scene": the command after its name, without the words "Usage:" that --help begins with.
std::string arguments_of(const CLI::App& verb) {
  std::string arguments = "[OPTIONS]";
  for (const auto* option : shown_options(verb))
    if (option->get_positional()) arguments += " " + CLI::Formatter{}.make_option_usage(option);
  return arguments;
}

std::string join(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); }

std::vector<std::string> option_names(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const auto* option : shown_options(verb)) {
    for (const auto& name : option->get_snames()) names.push_back("-" + name);
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

}  // namespace

std::string manual_page(const CLI::App& app) {
  const auto& name = app.get_name();
  auto page = fmt::format(".TH {} 1 \"\" \"{} {}\"\n.SH NAME\n{} \\- {}\n", "CHUTE", name, run::version, name,
                          "simulate grains on a rough incline and draw what they do");
  page += fmt::format(".SH SYNOPSIS\n\\fB{0}\\fR [OPTIONS] VERB ...\n.br\n", name);
  for (const auto* verb : shown_verbs(app))
    page += fmt::format("\\fB{} {}\\fR {}\n.br\n", name, verb->get_name(), plain(arguments_of(*verb)));
  page += fmt::format(".SH DESCRIPTION\n{}\n.SH OPTIONS\n", plain(app.get_description()));
  add_options(page, app);
  for (const auto* verb : shown_verbs(app)) {
    page += fmt::format(".SH {} {}\n{}.\n", name, verb->get_name(), plain(verb->get_description()));
    add_options(page, *verb);
    if (!verb->get_footer().empty()) page += fmt::format(".PP\n.nf\n{}\n.fi\n", plain(verb->get_footer()));
  }
  page +=
      ".SH EXIT STATUS\n"
      ".TP\n0\ndone\n"
      ".TP\n1\nthe work failed: a picture differs, a run left physics, the disk is full\n"
      ".TP\n2\nthe command or a file that it was given is wrong\n"
      ".SH ENVIRONMENT\n"
      ".TP\nCHUTE_SCENES\nfolder of the figures' recipes, in place of those that come with chute\n"
      ".SH FILES\n"
      ".TP\n.I share/chute/scenes\n"
      "scenes and recipes of figures to copy from, in the folder beside that of the program: of the "
      "package,\n"
      "/usr/share/chute/scenes\n"
      ".TP\n.I share/doc/chute/README.md\nthe manual\n";
  return page;
}

std::string bash_completion(const CLI::App& app) {
  const auto& name = app.get_name();
  std::vector<std::string> verbs;
  std::string cases;
  for (const auto* verb : shown_verbs(app)) {
    verbs.push_back(verb->get_name());
    cases += fmt::format("    {}) options=\"{}\" ;;\n", verb->get_name(), join(option_names(*verb)));
  }
  return fmt::format(R"bash(# Completion of {name} for bash, made by the program that it completes.
_{name}() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} verb=${{COMP_WORDS[1]}} options=""
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    COMPREPLY=($(compgen -W "{verbs} {options}" -- "$word"))
    return
  fi
  case $verb in
{cases}  esac
  if [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$word"))
  elif [[ $verb == figure && $word != */* ]]; then
    COMPREPLY=($(compgen -W "all $("$1" figure --list 2>/dev/null | cut -d ' ' -f 1)" -- "$word"))
  fi
  # No reply of ours: bash completes the name of a file.
}}
complete -o default -F _{name} {name}
)bash",
                     fmt::arg("name", name), fmt::arg("verbs", join(verbs)),
                     fmt::arg("options", join(option_names(app))), fmt::arg("cases", cases));
}

void add_manual(CLI::App& app) {
  // As --version does: the answer is thrown, so that no verb is missed.
  const auto answer = [&app](const char* option, std::string (*text)(const CLI::App&)) {
    app.add_flag_callback(option, [&app, text] { throw CLI::CallForVersion(text(app), 0); })->group("");
  };
  answer("--manual-page", manual_page);
  answer("--bash-completion", bash_completion);
}

}  // namespace chute::app
