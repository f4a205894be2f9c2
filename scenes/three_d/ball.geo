// A ball of radius 1 with an interaction domain of width delta, tetrahedra of size h.
SetFactory("OpenCASCADE");
DefineConstant[ h = 0.5, delta = 0.5 ];

// faces of the outer polyhedron lie inside its sphere: the layer is h/4 wider than it needs to be
Sphere(1) = {0, 0, 0, 1};
Sphere(2) = {0, 0, 0, 1 + delta + h / 4};
BooleanFragments{ Volume{2}; Delete; }{ Volume{1}; Delete; }
Physical Volume("omega") = {1};
Physical Volume("collar") = {2};

Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
Mesh.OptimizeThreshold = 0.7; // fewer thin tetrahedra
