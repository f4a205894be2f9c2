// A bar of two materials: a grip, a soft part and a stiff part, tetrahedra of size h.
SetFactory("OpenCASCADE");
DefineConstant[ h = 0.25, delta = 0.5 ];

Box(1) = {-0.5, 0, 0, 0.5, 0.5, 0.5};
Box(2) = {0, 0, 0, 1, 0.5, 0.5};
Box(3) = {1, 0, 0, 1, 0.5, 0.5};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2, 3}; Delete; }
Physical Volume("collar_grip") = {1};
Physical Volume("omega_soft") = {2};
Physical Volume("omega_stiff") = {3};

Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
Mesh.OptimizeThreshold = 0.7; // fewer thin tetrahedra
