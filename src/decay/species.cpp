#include "decay/species.h"

#include "core/error.h"
#include "core/nearest_name.h"

namespace windfall::decay {

double cardinal_growth(const CardinalValues& values, double x) {
    const auto [low, best, high] = values;
    if (x <= low || x >= high) return 0;
    const double rise = best - low;
    return (x - high) * (x - low) * (x - low) /
           (rise * (rise * (x - best) - (best - high) * (best + low - 2 * x)));
}

const std::vector<Species>& species() {
    static const std::vector<Species> list = {
        {"erwinia",
         "bacterial soft rot (Pectobacterium carotovorum)",
         OrganismKind::SoftRot,
         {3, 28.5, 38},
         {0.945, 0.997, 1.01},
         "minimum 3-6 C for the cold-hardy kind: C.-H. Liao in G. M. Sapers et al., Microbiology of Fruits "
         "and Vegetables, 2006, section 5.3.2; fast growth at 0.960-0.997: E. Moh et al., Biotechnol. Agron. "
         "Soc. Environ. 15(3), 2011; best near 28-30 C in the handbooks; maximum temperature and minimum "
         "water activity assumed"},
        {"penicillium-digitatum",
         "green mould",
         OrganismKind::Fungus,
         {3, 24.5, 36},
         {0.90, 0.995, 1.01},
         "P. Plaza, J. Usall, N. Teixido, I. Vinas, J. Appl. Microbiol. 94, 2003 (4-37 C, aw 0.87-0.99: "
         "grows at 4-30 C, not at 37 C); fitted"},
        {"penicillium-expansum",
         "blue mould",
         OrganismKind::Fungus,
         {-3, 24.5, 35},
         {0.83, 0.985, 1.01},
         "C. Tannous et al., Food Sci. Nutr. 4(4), 2016 (best 24 C, aw 0.99); minima: J. I. Pitt, A. D. "
         "Hocking, Fungi and Food Spoilage, 2009"},
        {"rhizopus",
         "whisker mould (Rhizopus stolonifer)",
         OrganismKind::Fungus,
         {3, 26, 36},
         {0.84, 0.995, 1.01},
         "J. I. Pitt, A. D. Hocking, Fungi and Food Spoilage, 2009; best water activity assumed"},
        {"neofabraea",
         "bull's eye rot (Neofabraea vagabunda)",
         OrganismKind::Fungus,
         {-1, 20, 30},
         {0.90, 0.995, 1.01},
         "cold-growing: rots apples in cold store, and is cultured at 15-20 C (Italian isolates, IOBC-WPRS); "
         "the numbers are assumed"},
        {"botrytis",
         "grey mould (Botrytis cinerea)",
         OrganismKind::Fungus,
         {-2, 21.5, 32},
         {0.93, 0.995, 1.01},
         "best at 17-23 C and 95 % humidity, grows just above freezing: INRAE ephytia; limits: J. I. Pitt, "
         "A. D. Hocking, Fungi and Food Spoilage, 2009"},
    };
    return list;
}

const Species& species_named(const std::string& name) {
    std::vector<std::string> names;
    std::string all;
    for (const Species& one : species()) {
        if (one.name == name) return one;
        names.push_back(one.name);
        all += (all.empty() ? "" : ", ") + one.name;
    }
    const auto nearest = nearest_names(name, names);
    const std::string hint = nearest.empty() ? "" : " (did you mean '" + nearest.front() + "'?)";
    throw InputError("there is no organism '" + name + "'" + hint + ": the organisms are " + all);
}

}  // namespace windfall::decay
