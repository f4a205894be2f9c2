#pragma once

#include "study/certificate.h"
#include "study/grade.h"

#include <filesystem>
#include <string>
#include <vector>

// The certified problems that come with the program, NLB-01 and so on, and files of values.
namespace plumbline::app
{
  /// The prefix under which the running command is installed, if it is.
  std::filesystem::path prefix_of_command();

  /// Folder of the scenes: PREFIX/share/plumbline/scenes, else that of the source tree.
  std::filesystem::path scenes_folder(const std::filesystem::path &prefix);

  /// Names of the set in order, e.g. NLB-01.
  /// @throws InputError  there is no set
  std::vector<std::string> certified_names(const std::filesystem::path &prefix);

  /// A certificate of the set by its name, in any case and with '-' or '_'; or one that 'certify'
  /// has written, by the name of its file. Its hash is checked.
  /// @throws InputError  no such file or problem, with all names; no certificate; a hash that is
  /// not that of the scene's text
  study::Certificate certificate_of(const std::string &problem,
                                    const std::filesystem::path &prefix);

  /// Values of another code, for all points of a certificate in any order.
  /// @param file  CSV with the points' coordinates and u, or of vectors u,v[,w] or u1,u2[,u3]
  /// @throws InputError  columns, lines or points that are not those of the certificate
  study::GivenValues read_values(const std::string &file, const study::Certificate &certificate);

  /// The points of a certificate as CSV, which read_values() takes with columns of u beside them.
  std::string points_csv(const study::Certificate &certificate);

  /// Of a point, for messages.
  std::string place_text(const std::vector<double> &x);
} // namespace plumbline::app
