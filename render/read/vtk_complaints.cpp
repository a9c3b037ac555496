#include "read/vtk_complaints.hpp"

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <mutex>
#include <string_view>

namespace chute::read {
namespace {

/// The first thing that VTK complained of while this thread read a file.
thread_local std::string first_complaint;

/// Where VTK sends its complaints: kept, not printed.
class Complaints : public vtkOutputWindow {
 public:
  static Complaints* New();
  vtkTypeMacro(Complaints, vtkOutputWindow);
  void DisplayText(const char*) override {}
  void DisplayErrorText(const char* text) override { keep(text); }
  void DisplayWarningText(const char*) override {}
  void DisplayGenericWarningText(const char*) override {}
  void DisplayDebugText(const char*) override {}

 private:
  void keep(const char* text) {
    std::string& first = first_complaint;
    if (!first.empty()) return;
    // "ERROR: In FILE, line N\nvtkClass (0x…): what is wrong\n"; the address is another in each run
    std::string_view what = text;
    if (what.starts_with("ERROR:")) what.remove_prefix(std::min(what.find('\n') + 1, what.size()));
    if (const auto address = what.find(" (0x"), end = what.find("): ");
        address != what.npos && end != what.npos && what.find(' ') == address)
      what.remove_prefix(end + 3);
    for (char c : what)  // it quotes what stands in files
      first += c == '\n' || c == '\r' || c == '\t' ? ' ' : c < ' ' || c > '~' ? '?' : c;
    first.erase(first.find_last_not_of(" .") + 1);
    if (first.empty()) first = "VTK cannot read it";
    if (first.size() > 160) first = first.substr(0, 157) + "...";
  }
};
vtkStandardNewMacro(Complaints);

std::mutex mutex;
int count = 0;  // of those that listen
vtkSmartPointer<vtkOutputWindow> before;
vtkLogger::Verbosity verbosity{};

}  // namespace

// VTK's logger would print what goes to its output window, too.
Listening::Listening() {
  first_complaint.clear();
  const std::lock_guard lock(mutex);
  if (count++ > 0) return;
  before = vtkOutputWindow::GetInstance(), verbosity = vtkLogger::GetCurrentVerbosityCutoff();
  vtkOutputWindow::SetInstance(vtkNew<Complaints>());
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

Listening::~Listening() {
  const std::lock_guard lock(mutex);
  if (--count > 0) return;
  vtkOutputWindow::SetInstance(before);
  vtkLogger::SetStderrVerbosity(verbosity);
  before = nullptr;
}

const std::string& Listening::complaint() { return first_complaint; }

}  // namespace chute::read
