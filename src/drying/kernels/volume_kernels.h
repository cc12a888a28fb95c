// Volumes of the hexahedra. Included inside the namespace of one instruction set (see lanes.h).

template <int L>
void volumes(const ElementArrays& e, const double* displacement, double* out, Range quads) {
    using D = typename LaneTypes<L>::D;
    for (int quad = quads.begin; quad < quads.end; ++quad) {
        const Nodes<L> nodes(e, displacement, quad);
        D fresh = {};
        D now = {};
        D least = fresh + 1e30;
        D largest = -least;
        for (int g = 0; g < 8; ++g) {
            D jacobians[9];
            D cofactors[9];
            jacobian(nodes.rest, g, jacobians);
            const D w0 = cofactor_matrix(jacobians, cofactors);
            jacobian(nodes.now, g, jacobians);
            const D w1 = cofactor_matrix(jacobians, cofactors);
            const D ratio = w1 / w0;
            fresh += w0;
            now += w1;
            least = ratio < least ? ratio : least;
            largest = ratio > largest ? ratio : largest;
        }
        D* entries = reinterpret_cast<D*>(out + quad * kVolumeEntries * L);
        entries[0] = fresh;
        entries[1] = now;
        entries[2] = least;
        entries[3] = largest;
    }
}
