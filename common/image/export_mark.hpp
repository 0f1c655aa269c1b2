/// \file
/// Marks in the files that Seeker exports under names made up from one that the user gives (NAME.png, NAME.yaml ...).
/// By them it recognises what it may overwrite: a file without the mark belongs to somebody else.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace seeker::image {

/// One mark a kind: an export never overwrites one of another kind.
inline constexpr std::string_view kMapExport = "Seeker map export";
inline constexpr std::string_view kLandmarksExport = "Seeker landmarks export";
inline constexpr std::string_view kCameraPicture = "Seeker camera picture";
inline constexpr std::string_view kLinesPicture = "Seeker picture of lines";

/// The mark as a line of a text file whose comments begin with '#'.
[[nodiscard]] std::string comment_mark(std::string_view mark);
/// The mark as a line of an XML file.
[[nodiscard]] std::string xml_mark(std::string_view mark);
/// An XML document, which begins with a line for its declaration, with the mark behind that line.
[[nodiscard]] std::string with_xml_mark(std::string document, std::string_view mark);
/// The mark as a member of a JSON object.
[[nodiscard]] std::string json_mark(std::string_view mark);

/// Whether a regular file begins as an export with this mark does, in any of the forms above or that of write_png().
[[nodiscard]] bool carries_mark(const std::filesystem::path& path, std::string_view mark);

}  // namespace seeker::image
