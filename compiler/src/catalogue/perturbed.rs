//! Splittings for nearly integrable systems `H = A + εB`, `A` solved by the drifts and `B` by the kicks.
//!
//! Order `(s₁, s₂, …)` is a local error `O(εh^{s₁+1} + ε²h^{s₂+1} + ⋯)`. The kicks of `SABA_n` and `SBAB_n` are the
//! weights of the Gauss and Lobatto formulas, and the drifts are the differences of their nodes; their order is `(2n, 2)`.
//! Without a short closed form, their digits are certified with this order. The digits of the others are certified too.
//! The digits are those of `schema.f` of the IMCCE (Gastineau 2012) and of REBOUND (`integrator_saba.c`).

use super::Row;

pub(super) const ROWS: &[Row] = &[
    Row {
        name: "saba-1",
        title: "drifts between Gauss nodes, kicks with Gauss weights",
        definition: "kick: [1], drift: [1/2], first: drift, symmetric: true",
        stages: &[2],
        source: LASKAR,
    },
    Row {
        name: "saba-2",
        title: "drifts between Gauss nodes, kicks with Gauss weights",
        definition: "kick: [1/2], drift: [1/2 - sqrt(3)/6, sqrt(3)/3], first: drift, symmetric: true",
        stages: &[3],
        source: LASKAR,
    },
    Row {
        name: "saba-3",
        title: "drifts between Gauss nodes, kicks with Gauss weights",
        definition: "kick: [5/18, 4/9], drift: [1/2 - sqrt(15)/10, sqrt(15)/10], first: drift, symmetric: true",
        stages: &[4],
        source: LASKAR,
    },
    Row {
        name: "saba-4",
        title: "drifts between Gauss nodes, kicks with Gauss weights",
        definition: "kick: [1/4 - sqrt(30)/72, 1/4 + sqrt(30)/72], \
                     drift: [1/2 - sqrt(525 + 70*sqrt(30))/70, sqrt(525 + 70*sqrt(30))/70 - sqrt(525 - 70*sqrt(30))/70, \
                     sqrt(525 - 70*sqrt(30))/35], first: drift, symmetric: true",
        stages: &[5],
        source: LASKAR,
    },
    Row {
        name: "saba-5",
        title: "drifts between Gauss nodes, kicks with Gauss weights",
        definition: "kick: [161/900 - 13*sqrt(70)/1800, 161/900 + 13*sqrt(70)/1800, 64/225], drift: [1/2 - sqrt(490 - \
                     42*sqrt(105))/84 - sqrt(490 + 42*sqrt(105))/84, sqrt(490 - 42*sqrt(105))/42, sqrt(490 + \
                     42*sqrt(105))/84 - sqrt(490 - 42*sqrt(105))/84], first: drift, symmetric: true",
        stages: &[6],
        source: LASKAR,
    },
    Row {
        name: "saba-6",
        title: "drifts between Gauss nodes, kicks with Gauss weights",
        definition: "kick: [0.085662246189585172520148071086366446763411250742022, \
                     0.18038078652406930378491675691885805583076094637337, \
                     0.23395696728634552369493517199477549740582780288461], drift: \
                     [0.033765242898423986093849222753002695432617131143855, \
                     0.13563006386844375707545097973704463106415858665856, \
                     0.21129510019153380251544893666959670579391896712757, \
                     0.23861918608319690863050172168071193541861063014002], first: drift, symmetric: true, claim: \
                     perturbed(12, 2)",
        stages: &[7],
        source: LASKAR,
    },
    Row {
        name: "saba-7",
        title: "drifts between Gauss nodes, kicks with Gauss weights",
        definition: "kick: [0.064742483084434846635305716339541009164293701129973, \
                     0.1398526957446383339507338857118897912434625326133, \
                     0.19091502525255947247518488774448756693918254176693, 256/1225], drift: \
                     [0.025446043828620737736905157976074368799614531164691, \
                     0.10378836337168204233116245538353142766331164526461, \
                     0.16784301711099863647862918060191347186338281652101, \
                     0.20292257568869858345330320603848073167369100704969], first: drift, symmetric: true, claim: \
                     perturbed(14, 2)",
        stages: &[8],
        source: LASKAR,
    },
    Row {
        name: "saba-8",
        title: "drifts between Gauss nodes, kicks with Gauss weights",
        definition: "kick: [0.050614268145188129576265677154981095057697045525842, \
                     0.11119051722668723527217799721312044221506543502562, \
                     0.15685332293894364366898110099330065663016449950137, \
                     0.18134189168918099148257522463859780609707301994717], drift: \
                     [0.019855071751231884158219565715263504785882382849274, \
                     0.081811689541954746046003466046821276795531751342744, \
                     0.13556703374864887688690744364329204389760374424779, \
                     0.17104888371033959043913145341453118418760321510371, \
                     0.18343464249564980493947614236018398066675781291297], first: drift, symmetric: true, claim: \
                     perturbed(16, 2)",
        stages: &[9],
        source: LASKAR,
    },
    Row {
        name: "sbab-1",
        title: "drifts between Lobatto nodes, kicks with Lobatto weights",
        definition: "kick: [1/2], drift: [1], symmetric: true",
        stages: &[2],
        source: LASKAR,
    },
    Row {
        name: "sbab-2",
        title: "drifts between Lobatto nodes, kicks with Lobatto weights",
        definition: "kick: [1/6, 2/3], drift: [1/2], symmetric: true",
        stages: &[3],
        source: LASKAR,
    },
    Row {
        name: "sbab-3",
        title: "drifts between Lobatto nodes, kicks with Lobatto weights",
        definition: "kick: [1/12, 5/12], drift: [1/2 - sqrt(5)/10, sqrt(5)/5], symmetric: true",
        stages: &[4],
        source: LASKAR,
    },
    Row {
        name: "sbab-4",
        title: "drifts between Lobatto nodes, kicks with Lobatto weights",
        definition: "kick: [1/20, 49/180, 16/45], drift: [1/2 - sqrt(21)/14, sqrt(21)/14], symmetric: true",
        stages: &[5],
        source: LASKAR,
    },
    Row {
        name: "sbab-5",
        title: "drifts between Lobatto nodes, kicks with Lobatto weights",
        definition: "kick: [1/30, 7/30 - sqrt(7)/60, 7/30 + sqrt(7)/60], drift: [1/2 - sqrt(3 + 6/sqrt(7))/6, sqrt(3 + \
                     6/sqrt(7))/6 - sqrt(3 - 6/sqrt(7))/6, sqrt(3 - 6/sqrt(7))/3], symmetric: true",
        stages: &[6],
        source: LASKAR,
    },
    Row {
        name: "sbab-6",
        title: "drifts between Lobatto nodes, kicks with Lobatto weights",
        definition: "kick: [1/42, 31/175 - sqrt(15)/100, 31/175 + sqrt(15)/100, 128/525], drift: [1/2 - sqrt((15 + \
                     2*sqrt(15))/33)/2, sqrt((15 + 2*sqrt(15))/33)/2 - sqrt((15 - 2*sqrt(15))/33)/2, sqrt((15 - \
                     2*sqrt(15))/33)/2], symmetric: true",
        stages: &[7],
        source: LASKAR,
    },
    Row {
        name: "sbab-7",
        title: "drifts between Lobatto nodes, kicks with Lobatto weights",
        definition: "kick: [1/56, 0.10535211357175301969149603288787816222767308308052, \
                     0.17056134624175218238212033855387408588755548780279, \
                     0.20622939732935194078352648570110489474191428625954], drift: \
                     [0.064129925745196692331277119389668280948109665161508, \
                     0.14001998353823215659646751491135512407903984007983, \
                     0.19120048176533171668792673552630096732507779221533, \
                     0.20929921790247886876865726034535125529554540508668], symmetric: true, claim: perturbed(14, 2)",
        stages: &[8],
        source: LASKAR,
    },
    Row {
        name: "sbab-8",
        title: "drifts between Lobatto nodes, kicks with Lobatto weights",
        definition: "kick: [1/72, 0.08274768078040276252316986001460415291955361461258, \
                     0.13726935625008086764035280928968636297062561049325, \
                     0.17321425548652317255756576606985914397376635312546, 2048/11025], drift: \
                     [0.050121002294269921343827377790831020974259852216948, \
                     0.1112858579503612019332299086634977536702253239761, \
                     0.15703440784227979736756667919134161884519368500651, \
                     0.18155873191308907935537603435432960651032113880044], symmetric: true, claim: perturbed(16, 2)",
        stages: &[9],
        source: LASKAR,
    },
    Row {
        name: "mclachlan-1995-aba-8-4",
        title: "five kicks a step, order (8, 4) for a small U",
        definition: "kick: [0.19022593937367661925, 0.84652407044352625706, -1.07350001963440575260], drift: \
                     [0.07534696026989288842, 0.51791685468825678230, -0.09326381495814967072], first: drift, \
                     symmetric: true, claim: perturbed(8, 4)",
        stages: &[6],
        source: "McLachlan, Composition methods in the presence of small parameters, BIT 35 (1995)",
    },
    Row {
        name: "mclachlan-1995-bab-8-4",
        title: "five drifts a step, order (8, 4) for a small U",
        definition: "kick: [0.81186273854451628884, -0.67748039953216912289, 0.36561766098765283405], drift: \
                     [-0.00758691311877447385, 0.31721827797316981388, 0.38073727029120931994], symmetric: true, claim: \
                     perturbed(8, 4)",
        stages: &[6],
        source: "McLachlan, Composition methods in the presence of small parameters, BIT 35 (1995)",
    },
    Row {
        name: "blanes-2013-aba-10-4",
        title: "seven kicks a step, order (10, 4) for a small U",
        definition: "kick: [0.1188819173681970199453503950853885936957, 0.2410504605515015657441667865901651105675, \
                     -0.2732866667053238060543113981664559460630, 0.8267085775712504407295884329818044835997], drift: \
                     [0.04706710064597250612947887637243678556564, 0.1847569354170881069247376193702560968574, \
                     0.2827060056798362053243616565541452479160, -0.01453004174289681837857815229683813033908], first: \
                     drift, symmetric: true, claim: perturbed(10, 4)",
        stages: &[8],
        source: "Blanes, Casas, Farrés, Laskar, Makazaga & Murua, New families of symplectic splitting methods for \
                 numerical integration in dynamical astronomy, Appl. Numer. Math. 68 (2013), ABA(10, 4)",
    },
    Row {
        name: "blanes-2013-aba-8-6-4",
        title: "seven kicks a step, order (8, 6, 4) for a small U",
        definition: "kick: [0.183083687472197221961703757166430291072, 0.310782859898574869507522291054262796375, \
                     -0.0265646185119588006972121379164987592663, 0.0653961422823734184559721793911134363710], drift: \
                     [0.0711334264982231177779387300061549964174, 0.241153427956640098736487795326289649618, \
                     0.521411761772814789212136078067994229991, -0.333698616227678005726562603400438876027], first: \
                     drift, symmetric: true, claim: perturbed(8, 6, 4)",
        stages: &[8],
        source: "Blanes, Casas, Farrés, Laskar, Makazaga & Murua, New families of symplectic splitting methods for \
                 numerical integration in dynamical astronomy, Appl. Numer. Math. 68 (2013), ABA(8, 6, 4)",
    },
    Row {
        name: "blanes-2013-aba-10-6-4",
        title: "eight kicks a step, order (10, 6, 4) for a small U",
        definition: "kick: [0.09585888083707521061077150377145884776921, 0.2044461531429987806805077839164344779763, \
                     0.2170703479789911017143385924306336714532, -0.01737538195906509300561788011852699719871], drift: \
                     [0.03809449742241219545697532230863756534060, 0.1452987161169137492940200726606637497442, \
                     0.2076276957255412507162056113249882065158, 0.4359097036515261592231548624010651844006, \
                     -0.6538612258327867093807117373907094120024], first: drift, symmetric: true, claim: perturbed(10, \
                     6, 4)",
        stages: &[9],
        source: "Blanes, Casas, Farrés, Laskar, Makazaga & Murua, New families of symplectic splitting methods for \
                 numerical integration in dynamical astronomy, Appl. Numer. Math. 68 (2013), ABA(10, 6, 4)",
    },
];

const LASKAR: &str = "Laskar & Robutel, High order symplectic integrators for perturbed Hamiltonian systems, \
                      Celest. Mech. Dyn. Astron. 80 (2001); McLachlan, BIT 35 (1995); \
                      of a high order in the size of a perturbation U, of order 2 in the step";
