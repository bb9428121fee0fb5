//! A small STEP file, and the GLB file that a converter would return for it.

use std::fmt::Write;

/// A box in a STEP file: product name, corner opposite to the origin, and colour.
pub struct StepBox {
    pub name: &'static str,
    pub size: [f64; 3],
    pub colour: [f64; 3],
}

/// The entities of a STEP file, numbered from 1.
#[derive(Default)]
struct StepEntities(Vec<String>);

impl StepEntities {
    /// Appends an entity and returns its number, such as `#7`.
    fn add(&mut self, text: &str) -> String {
        let number = format!("#{}", self.0.len() + 1);
        self.0.push(format!("{number}={text};"));
        number
    }

    fn point(&mut self, [x, y, z]: [f64; 3]) -> String {
        self.add(&format!("CARTESIAN_POINT('',({x:?},{y:?},{z:?}))"))
    }

    /// A direction along an axis. The sign of `length` is the sign of the direction.
    fn axis(&mut self, axis: usize, length: f64) -> String {
        let [x, y, z] = [0, 1, 2].map(|other| if other == axis { length } else { 0.0 });
        self.add(&format!("DIRECTION('',({x:?},{y:?},{z:?}))"))
    }

    /// A box between the origin and `size`, as a boundary representation.
    fn solid(&mut self, size: [f64; 3]) -> String {
        let corner = |corner: usize| [0, 1, 2].map(|a| if corner >> a & 1 == 1 { size[a] } else { 0.0 });
        let points: Vec<String> = (0..8).map(|i| self.point(corner(i))).collect();
        let ends: Vec<String> =
            points.iter().map(|point| self.add(&format!("VERTEX_POINT('',{point})"))).collect();
        let mut edges = std::collections::BTreeMap::new();
        for axis in 0..3 {
            let way = self.axis(axis, 1.0);
            let vector = self.add(&format!("VECTOR('',{way},1.)"));
            for from in (0..8).filter(|corner| corner >> axis & 1 == 0) {
                let to = from | 1 << axis;
                let line = self.add(&format!("LINE('',{},{vector})", points[from]));
                let edge = format!("EDGE_CURVE('',{},{},{line},.T.)", ends[from], ends[to]);
                edges.insert((from, to), self.add(&edge));
            }
        }
        let mut faces = Vec::new();
        for axis in 0..3 {
            let [b, c] = [(axis + 1) % 3, (axis + 2) % 3];
            for side in 0..2 {
                let base = side << axis;
                let mut corners = [base, base | 1 << b, base | 1 << b | 1 << c, base | 1 << c];
                if side == 0 {
                    corners.reverse();
                }
                let loops: Vec<String> = (0..4)
                    .map(|k| {
                        let [from, to] = [corners[k], corners[(k + 1) % 4]];
                        let (edge, way) = match edges.get(&(from, to)) {
                            Some(edge) => (edge, "T"),
                            None => (&edges[&(to, from)], "F"),
                        };
                        let edge = format!("ORIENTED_EDGE('',*,*,{edge},.{way}.)");
                        self.add(&edge)
                    })
                    .collect();
                let edge_loop = self.add(&format!("EDGE_LOOP('',({}))", loops.join(",")));
                let bound = self.add(&format!("FACE_OUTER_BOUND('',{edge_loop},.T.)"));
                let normal = self.axis(axis, if side == 1 { 1.0 } else { -1.0 });
                let right = self.axis(b, 1.0);
                let frame = self.add(&format!("AXIS2_PLACEMENT_3D('',{},{normal},{right})", points[base]));
                let plane = self.add(&format!("PLANE('',{frame})"));
                faces.push(self.add(&format!("ADVANCED_FACE('',({bound}),{plane},.T.)")));
            }
        }
        let shell = self.add(&format!("CLOSED_SHELL('',({}))", faces.join(",")));
        self.add(&format!("MANIFOLD_SOLID_BREP('',{shell})"))
    }

    /// Assigns a colour to a solid.
    fn coloured(&mut self, solid: &str, [r, g, b]: [f64; 3]) -> String {
        let mut last = self.add(&format!("COLOUR_RGB('',{r:?},{g:?},{b:?})"));
        for around in [
            "FILL_AREA_STYLE_COLOUR('',@)",
            "FILL_AREA_STYLE('',(@))",
            "SURFACE_STYLE_FILL_AREA(@)",
            "SURFACE_SIDE_STYLE('',(@))",
            "SURFACE_STYLE_USAGE(.BOTH.,@)",
            "PRESENTATION_STYLE_ASSIGNMENT((@))",
        ] {
            last = self.add(&around.replace('@', &last));
        }
        self.add(&format!("STYLED_ITEM('',({last}),{solid})"))
    }

    /// A product and its shape. Returns the numbers of the definition and of the representation.
    fn product(
        &mut self,
        name: &str,
        [context, in_design]: [&str; 2],
        items: &[String],
        kind: &str,
    ) -> [String; 2] {
        let product = self.add(&format!("PRODUCT('{name}','{name}','',({context}))"));
        let version = self.add(&format!("PRODUCT_DEFINITION_FORMATION('','',{product})"));
        let definition = self.add(&format!("PRODUCT_DEFINITION('design','',{version},{in_design})"));
        let shape = self.add(&format!("PRODUCT_DEFINITION_SHAPE('','',{definition})"));
        let representation = self.add(&format!("{kind}('',({}),#9)", items.join(",")));
        self.add(&format!("SHAPE_DEFINITION_REPRESENTATION({shape},{representation})"));
        [definition, representation]
    }
}

/// An assembly `stand` of boxes, with lengths in mm or in inches.
pub fn step_assembly(boxes: &[StepBox], in_inches: bool) -> String {
    let mut lines = StepEntities::default();
    let application = lines.add("APPLICATION_CONTEXT('automotive design')");
    let millimetre = lines.add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))");
    let factor = lines.add(&format!("LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),{millimetre})"));
    let exponents = lines.add("DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.)");
    let inch = format!("(CONVERSION_BASED_UNIT('INCH',{factor})LENGTH_UNIT()NAMED_UNIT({exponents}))");
    let inch = lines.add(&inch);
    let unit = if in_inches { inch } else { millimetre };
    let angle = lines.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
    let solid_angle = lines.add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
    let precision = format!("UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-07),{unit},'','')");
    let precision = lines.add(&precision);
    let context = lines.add(&format!(
        "(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({precision}))\
         GLOBAL_UNIT_ASSIGNED_CONTEXT(({unit},{angle},{solid_angle}))REPRESENTATION_CONTEXT('',''))"
    ));
    assert_eq!(context, "#9");
    let of_product = lines.add(&format!("PRODUCT_CONTEXT('',{application},'mechanical')"));
    let in_design =
        lines.add(&format!("PRODUCT_DEFINITION_CONTEXT('part definition',{application},'design')"));
    let contexts = [of_product.as_str(), in_design.as_str()];
    let (origin, up, right) = (lines.point([0.0; 3]), lines.axis(2, 1.0), lines.axis(0, 1.0));
    let frame = lines.add(&format!("AXIS2_PLACEMENT_3D('',{origin},{up},{right})"));
    let [stand, of_stand] =
        lines.product("stand", contexts, std::slice::from_ref(&frame), "SHAPE_REPRESENTATION");
    let mut styled = Vec::new();
    for (number, StepBox { name, size, colour }) in boxes.iter().enumerate() {
        let solid = lines.solid(*size);
        styled.push(lines.coloured(&solid, *colour));
        let items = [frame.clone(), solid];
        let [part, of_part] = lines.product(name, contexts, &items, "ADVANCED_BREP_SHAPE_REPRESENTATION");
        // Many programs leave the name of the occurrence empty.
        let occurrence = format!("NEXT_ASSEMBLY_USAGE_OCCURRENCE('NAUO{number}','','',{stand},{part},$)");
        let occurrence = lines.add(&occurrence);
        let shape = lines.add(&format!("PRODUCT_DEFINITION_SHAPE('','',{occurrence})"));
        let place = lines.add(&format!("ITEM_DEFINED_TRANSFORMATION('','',{frame},{frame})"));
        let relation = lines.add(&format!(
            "(REPRESENTATION_RELATIONSHIP('','',{of_part},{of_stand})\
             REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION({place})SHAPE_REPRESENTATION_RELATIONSHIP())"
        ));
        lines.add(&format!("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION({relation},{shape})"));
    }
    lines.add(&format!(
        "MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',({}),{context})",
        styled.join(",")
    ));
    let mut text =
        "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n\
        FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n"
            .to_owned();
    for line in lines.0 {
        let _ = writeln!(text, "{line}");
    }
    text + "ENDSEC;\nEND-ISO-10303-21;\n"
}

/// A box of this size in metres, as GLB in the layout of Open CASCADE: the mesh is in a child of the
/// product's node, and that child is named by a reference.
pub fn converted_glb(product: &str, size: [f32; 3]) -> Vec<u8> {
    let corner = |corner: usize| [0, 1, 2].map(|axis| if corner >> axis & 1 == 1 { size[axis] } else { 0.0 });
    let positions = (0..8).flat_map(corner).flat_map(f32::to_le_bytes);
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let corners = quads.iter().flat_map(|[a, b, c, d]| [*a, *b, *c, *a, *c, *d]).flat_map(u16::to_le_bytes);
    let bin: Vec<u8> = positions.chain(corners).collect();
    let [x, y, z] = size;
    let mut json = format!(
        r#"{{"asset":{{"version":"2.0","generator":"Open CASCADE Technology 8.0"}},"scenes":[{{"nodes":[0]}}],
        "nodes":[{{"name":"{product}","children":[1]}},{{"name":"=>[0:1:1:3]","mesh":0}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":8,"min":[0,0,0],"max":[{x},{y},{z}]}},
        {{"bufferView":1,"componentType":5123,"type":"SCALAR","count":36}}],
        "bufferViews":[{{"buffer":0,"byteLength":96}},{{"buffer":0,"byteOffset":96,"byteLength":72}}],
        "buffers":[{{"byteLength":168}}]}}"#
    );
    while !json.len().is_multiple_of(4) {
        json.push(' ');
    }
    let length = |bytes: usize| u32::try_from(bytes).expect("a small file").to_le_bytes();
    let whole = length(12 + 8 + json.len() + 8 + bin.len());
    let parts: [&[u8]; 9] = [
        b"glTF",
        &2_u32.to_le_bytes(),
        &whole,
        &length(json.len()),
        b"JSON",
        json.as_bytes(),
        &length(bin.len()),
        b"BIN\0",
        &bin,
    ];
    parts.concat()
}
