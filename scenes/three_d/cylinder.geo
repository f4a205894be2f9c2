// A cylinder of radius 1/2 and height 1/2 with an interaction domain of width delta, hexahedra of size h.
SetFactory("OpenCASCADE");
DefineConstant[ h = 0.25, delta = 0.25 ];

// sides of the outer polygon lie inside its circle: the layer is h/4 wider than it needs to be
Disk(1) = {0, 0, -delta, 0.5};
Disk(2) = {0, 0, -delta, 0.5 + delta + h / 4};
BooleanFragments{ Surface{2}; Delete; }{ Surface{1}; Delete; }

// quadrilaterals of the disk and the ring become hexahedra below, in and above the domain
n = Ceil(delta / h - 0.001);
below[] = Extrude {0, 0, delta} { Surface{1, 2}; Layers{n}; Recombine; };
body[] = Extrude {0, 0, 0.5} { Surface{below[0], below[3]}; Layers{Ceil(0.5 / h - 0.001)}; Recombine; };
above[] = Extrude {0, 0, delta} { Surface{body[0], body[3]}; Layers{n}; Recombine; };
Physical Volume("omega") = {body[1]};
Physical Volume("collar") = {below[1], below[4], body[4], above[1], above[4]};

Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
Mesh.RecombineAll = 1;
Mesh.RecombinationAlgorithm = 3; // quadrilaterals only
