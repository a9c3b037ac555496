#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "read/text_frames.hpp"

namespace chute::read {

/// One output time of a run.
struct FrameFile {
  std::filesystem::path path;
  std::vector<std::filesystem::path> more =
      {};                           ///< further parts of the same time, one a processor or a kind of grains
  std::optional<double> time = {};  ///< if the index says; else the file itself may
  std::filesystem::path contacts = {};  ///< the contact network at that time, empty if there is none
  std::optional<TextPiece> piece =
      {};  ///< of a file of text, which may hold several frames: where this one stands
  std::optional<TextPiece> contacts_piece = {};  ///< the same of the contact network
  std::vector<TextPiece> more_pieces = {};       ///< the same of `more`, where these are files of text
  std::vector<std::filesystem::path> more_contacts = {};  ///< further parts of the contact network
  std::vector<TextPiece> more_contacts_pieces = {};       ///< and of these
};

/// Reads ParaView's time index (.pvd): times and files, sorted by time. Paths are relative to the index. Parts of one time
/// are one frame; a part that is named again for the same time replaces the earlier one, as a restart means it.
/// InputError, one line that names it, if it is missing, no XML, not a collection, or an entry lacks its file
/// or has a time that is no number.
std::vector<FrameFile> read_pvd(const std::filesystem::path& path);

/// Reads ParaView's other time index (.vtk.series, JSON): the same, without parts.
std::vector<FrameFile> read_series_index(const std::filesystem::path& path);

/// The frames of a run, in order. `source` is
/// - a run directory (its frames.pvd), or a directory of VTK files (any engine's), in natural order of their
/// names;
/// - an index of times (.pvd, .series), or one VTK file, also an index of parts (.pvtp, .pvtu, .pvti, .vtm …);
/// - a pattern with `*` and `?` in its last part, such as `post/dump*.vtk`;
/// and instead of VTK files dumps of LAMMPS or XYZ files, with one frame each or many, packed or not. Of these, frames with
/// a time stand in its order, and a time that comes again replaces the earlier one.
/// Dumps that each process of LAMMPS wrote for itself are named as LAMMPS names them, `post/dump.%` or `post/dump.*.%`
/// (dump_parts.hpp).
/// A file contacts/NAME beside frames/NAME is that frame's contact network. InputError if nothing is found.
std::vector<FrameFile> find_frames(const std::filesystem::path& source);

/// Gives frames the contact networks that `source` names: VTK files, tables (.csv) or dumps of entries, in any of the forms above.
/// A network in parts is attached with all of them. Where frames and networks tell their times before they are read, those of
/// one time belong together; else there must be as many networks as frames, in their order. InputError if they do not fit.
void attach_networks(std::vector<FrameFile>& frames, const std::filesystem::path& source);

/// The files of a frame, with all its parts.
std::vector<FileBytes> read_files(const FrameFile& frame);

/// A file of the run that `frame` belongs to, such as walls.vtp; empty if there is none.
std::filesystem::path find_beside(const FrameFile& frame, std::string_view name);

}  // namespace chute::read
