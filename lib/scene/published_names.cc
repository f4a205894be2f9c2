#include "scene/published_names.h"

namespace plumbline::scene
{
  const std::vector<PublishedName> &published_names()
  {
    // HHB: W. Hu, Y. D. Ha, F. Bobaru, Numerical integration in peridynamics, technical report,
    // University of Nebraska-Lincoln 2010. PA, IPA: partial areas in the plane; FV, PV: full and
    // partial volumes in space.
    const std::string plane = "Seleson 2014, doi:10.1016/j.cma.2014.06.016",
                      space = "Seleson & Littlewood 2016, doi:10.1016/j.camwa.2015.12.021";
    const std::vector<std::string> partial = {"PA-AC", "QWJ", "LAMMPS"};
    static const std::vector<PublishedName> table = {
        {"HHB", {"QWJ"}, plane},
        {"PA-HHB", {"QWJ"}, plane},
        {"PV-HHB", {"QWJ"}, space},
        {"PDLAMMPS", {"LAMMPS"}, "Parks et al. 2008, doi:10.1016/j.cpc.2008.06.011"},
        {"PA-PDLAMMPS", {"LAMMPS"}, plane},
        {"PV-PDLAMMPS", {"LAMMPS"}, space},
        {"FV", {"FA"}, space},
        {"GFDM", {"GFD"}, "Benito, Urena & Gavete 2001, doi:10.1016/S0307-904X(01)00029-4"},
        {"PA", partial, plane},
        {"partial area", partial, plane},
        {"PV", partial, space},
        {"partial volume", partial, space},
    };
    return table;
  }

  std::vector<std::string> published_names_of(const std::string &method)
  {
    std::vector<std::string> names;
    for (const PublishedName &one : published_names())
      if (one.ours == std::vector<std::string>{method})
        names.push_back(one.name);
    return names;
  }
} // namespace plumbline::scene
