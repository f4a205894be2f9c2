#pragma once

#include "study/certificate.h"
#include "study/grade.h"

#include <string>
#include <vector>

namespace plumbline::io
{
  /// Values of another code, for all points of a certificate in any order.
  /// @param file  CSV with the points' coordinates and u, or of vectors u,v[,w] or u1,u2[,u3]
  /// @throws InputError  columns, lines or points that are not those of the certificate
  study::GivenValues read_values(const std::string &file, const study::Certificate &certificate);

  /// The points of a certificate as CSV, which read_values() takes with columns of u beside them.
  std::string points_csv(const study::Certificate &certificate);

  /// Of a point, for messages.
  std::string place_text(const std::vector<double> &x);
} // namespace plumbline::io
