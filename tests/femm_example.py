"""A FEMM file that uses every section, and the model that it is."""

from fluxbore.fem.femm_model import (
    Arc,
    BlockLabel,
    BlockProperty,
    BoundaryProperty,
    CircuitProperty,
    FemmModel,
    Hole,
    Node,
    PointProperty,
    Segment,
)

TEXT = """[Format]      =  4.0
[Frequency]   =  0
[Precision]   =  1e-008
[MinAngle]    =  30
[DoSmartMesh] =  0
[Depth]       =  50
[LengthUnits] =  millimeters
[ProblemType] =  planar
[Coordinates] =  cartesian
[ACSolver]    =  0
[PrevType]    =  0
[PrevSoln]    =  ""
[Comment]     =  "a "quoted" word\\nand more"
[PointProps]   = 2
  <BeginPoint>
    <PointName> = "fixed"
    <I_re> = 0
    <I_im> = 0
    <A_re> = 0.25
    <A_im> = 0
  <EndPoint>
  <BeginPoint>
    <PointName> = "wire"
    <I_re> = -2
    <A_re> = 7
  <EndPoint>
[BdryProps]   = 3
  <BeginBdry>
    <BdryName> = "A=0"
    <BdryType> = 0
    <A_0> = 1
    <A_1> = 2
    <A_2> = 3
    <Phi> = 60
    <c0> = 9
  <EndBdry>
  <BeginBdry>
    <BdryName> = "open"
    <BdryType> = 2
    <A_0> = 9
    <c0> = 5
    <c1> = 6
  <EndBdry>
  <BeginBdry>
    <BdryName> = "odd"
    <BdryType> = 5
  <EndBdry>
[BlockProps]  = 3
  <BeginBlock>
    <BlockName> = "Air"
    <LamFill> = 0
  <EndBlock>
  <BeginBlock>
    <BlockName> = "steel"
    <Mu_x> = 1000
    <Mu_y> = 500
    <J_re> = 1.1
    <Sigma> = 5.8
    <LamType> = 1
    <LamFill> = .95
    <BHPoints> = 3
      0\t0
      1.0\t100
      1.5\t5000
  <EndBlock>
  <BeginBlock>
    <BlockName> = "Air"
    <H_c> = 979000
    <LamType> = 4
  <EndBlock>
[CircuitProps]  = 1
  <BeginCircuit>
    <CircuitName> = "coil"
    <TotalAmps_re> = 2
    <TotalAmps_im> = 0
    <CircuitType> = 1
  <EndCircuit>
[NumPoints] = 4
0\t0\t0\t0
10\t0\t1\t0
10\t10\t2\t3
0\t+1e1\t0\t0
[NumSegments] = 3
0\t1\t-1\t1\t0\t0
1\t2\t0.5\t0\t1\t4
3\t0\t0\t3\t0\t0
[NumArcSegments] = 1
2\t3\t180\t2.5\t2\t0\t1\t2.5
[NumHoles] = 1
1\t1\t2
[NumBlockLabels] = 2
5\t5\t2\t0.25\t1\t90\t2\t-400\t2
6 6 3 -1 0 0 1 1 0\t"theta + 180"
"""

MODEL = FemmModel(
    axisymmetric=False,
    unit="millimeters",
    depth=50.0,
    precision=1e-8,
    min_angle=30.0,
    comment=r'a "quoted" word\nand more',
    points=(PointProperty("fixed", 0.25), PointProperty("wire", None, -2.0)),
    boundaries=(
        BoundaryProperty("A=0", "prescribed", 1.0, 2.0, 3.0, 60.0),
        BoundaryProperty("open", "mixed", c0=5.0, c1=6.0),
        BoundaryProperty("odd", "antiperiodic"),
    ),
    materials=(
        BlockProperty("Air"),
        BlockProperty(
            "steel", 1000.0, 500.0, 0.0, 1.1e6, 5.8e6, "parallel to x", 0.95, ((0.0, 0.0), (1.0, 100.0), (1.5, 5000.0))
        ),
        BlockProperty("Air", coercivity=979000.0, lamination="wire"),
    ),
    circuits=(CircuitProperty("coil", 2.0),),
    nodes=(Node(0.0, 0.0), Node(10.0, 0.0, 0), Node(10.0, 10.0, 1, 3), Node(0.0, 10.0)),
    segments=(Segment(0, 1, None, 0), Segment(1, 2, 0.5, None, True, 4), Segment(3, 0, None, 2)),
    arcs=(Arc(2, 3, 180.0, 2.5, 1, False, 1),),
    holes=(Hole(1.0, 1.0, 2),),
    labels=(
        BlockLabel(5.0, 5.0, 1, 0.25, 0, 90.0, 2, -400.0, default=True),
        BlockLabel(6.0, 6.0, 2, magnetisation="theta + 180", group=1),
    ),
)


def edited(old: str, new: str) -> str:
    """TEXT with its first ``old`` as ``new``."""
    assert old in TEXT
    return TEXT.replace(old, new, 1)
