#include "runner/report/gnuplot.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <optional>
#include <spawn.h>
#include <system_error>
#include <unistd.h>

#include <sys/wait.h>

#include "runner/machine.hpp"
#include "runner/report/figures.hpp"
#include "runner/report/fonts.hpp"
#include "runner/store/files.hpp"

namespace grainsweep {
namespace {

/// What the child does with its files and signals before it becomes gnuplot.
struct ChildSetup {
  posix_spawn_file_actions_t files{};
  posix_spawnattr_t signals{};

  ChildSetup(const std::string& folder, const std::string& log) {
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addchdir_np(&files, folder.c_str());
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0666);
    posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
    posix_spawnattr_init(&signals);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&signals, &none);
    posix_spawnattr_setflags(&signals, POSIX_SPAWN_SETSIGMASK);
  }
  ChildSetup(const ChildSetup&) = delete;
  ChildSetup(ChildSetup&&) = delete;
  ChildSetup& operator=(const ChildSetup&) = delete;
  ChildSetup& operator=(ChildSetup&&) = delete;
  ~ChildSetup() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&signals);
  }
};

/// The exit status of the child; -1 if it did not end by itself.
int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return -1;
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// A gnuplot at work on a figure.
struct Drawer {
  pid_t process = 0;
  int start_error = 0;  ///< errno; 0 if it was started
};

Drawer start_gnuplot(const Figure& figure, const std::string& folder) {
  const ChildSetup setup(folder, figure.name + ".log");
  std::string name = "gnuplot", script = figure.name + ".gnuplot";
  const std::array<char*, 3> arguments = {name.data(), script.data(), nullptr};
  Drawer drawer;
  drawer.start_error = posix_spawnp(&drawer.process, name.c_str(), &setup.files, &setup.signals,
                                    arguments.data(), environ);
  return drawer;
}

/// The picture, once it is drawn; nothing if it could not be.
std::optional<std::string> picture_of(const Figure& figure, const Drawer& drawer,
                                      const std::string& folder) {
  if (drawer.start_error != 0 || wait_for(drawer.process) != 0) return std::nullopt;
  const std::string start = folder + "/" + figure.name;
  if (!file_exists(start + ".svg")) return std::nullopt;
  remove_file(start + ".log");
  return read_file(start + ".svg");
}

/// A figure that is not drawn needs no log where gnuplot was not even there.
std::string why_none(const std::vector<Drawer>& drawers, const std::string& failed,
                     const std::string& folder) {
  for (const Drawer& drawer : drawers) {
    if (drawer.start_error == ENOENT) {
      return "no figures, for want of gnuplot (Debian: apt-get install gnuplot-nox)";
    }
    if (drawer.start_error != 0) {
      return "no figures, gnuplot could not be started: " +
             std::generic_category().message(drawer.start_error);
    }
  }
  return failed.empty() ? "" : "gnuplot could not draw" + failed + "; its words are in " + folder;
}

}  // namespace

std::string gnuplot_version() {
  const Said said = said_by("gnuplot --version 2>/dev/null");
  return said.code == 0 ? said.text.substr(0, said.text.find('\n')) : "";
}

void remove_figures(const std::string& folder) {
  for (const std::string& name : files_in(folder, "", "")) {
    const std::string stem = name.substr(0, name.find('.'));
    const bool is_ours =
        std::find(figure_names.begin(), figure_names.end(), stem) != figure_names.end();
    if (is_ours) remove_file(folder + "/" + name);
  }
}

Drawing draw(const std::vector<Figure>& figures, const std::string& folder) {
  make_folder_inside(folder);
  remove_figures(folder);
  const Characters in_png = installed_characters();
  std::vector<const Figure*> to_draw;
  for (const Figure& figure : figures) {
    for (const auto& [name, table] : figure.tables) replace_file(folder + "/" + name, table);
    if (!figure.not_drawn.empty()) continue;
    replace_file(folder + "/" + figure.name + ".gnuplot", drawing_commands(figure, in_png));
    to_draw.push_back(&figure);
  }
  std::vector<Drawer> drawers;  // once no file can fail: each has to be waited for
  drawers.reserve(to_draw.size());
  for (const Figure* figure : to_draw) drawers.push_back(start_gnuplot(*figure, folder));
  Drawing drawing{std::vector<std::string>(figures.size()), ""};
  std::string failed;
  for (std::size_t k = 0; k < to_draw.size(); ++k) {
    const auto svg = picture_of(*to_draw[k], drawers[k], folder);
    if (!svg) failed += " " + to_draw[k]->name;
    drawing.svgs[static_cast<std::size_t>(to_draw[k] - figures.data())] = svg.value_or("");
  }
  drawing.missing = why_none(drawers, failed, folder);
  return drawing;
}

}  // namespace grainsweep
