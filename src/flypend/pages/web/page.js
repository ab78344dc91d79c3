(()=>{var sd='(()=>{var tt={t:1,x:3,x_dot:3,quat_xyzw:4,y:3,y_dot:3,thrust:1,rotor_forces:0,x_ref:3,clearance:1,excess:1,V:1},et=.15,st=100;function N(i,t,s,e){let{facts:n,row:r}=i,{rotors:c,period:o}=n,a=n.e3==="up"?1:-1,h={...tt,rotor_forces:c};n.clear||delete h.clearance,n.lyapunov||delete h.V;let l=Object.fromEntries(Object.entries(h).map(([u,m])=>[u,new Float64Array(m*s.length)]));return s.forEach((u,m)=>{let p=t.subarray(u*r,(u+1)*r),v=(e+u)*o,[_,R,T,j,M,S,$]=i.shown(v,p),E=g=>[p[g],a*p[g+1],a*p[g+2]],[J,Q,X,Z]=nt(p.subarray(6,15)),z={t:[v],x:E(0),x_dot:E(3),quat_xyzw:[J,a*Q,a*X,Z],y:E(18),y_dot:E(21),thrust:[j],rotor_forces:p.subarray(n.state),x_ref:[_,R,T],clearance:[M],excess:[S],V:[$]};for(let g of Object.keys(l))l[g].set(z[g],h[g]*m)}),l}function q(i,t,s){let{row:e,facts:{period:n}}=i,r=t.length/e,c=Math.max(1,Math.round(1/(st*n))),o=(l,u)=>Math.hypot(t[l*e+u],t[l*e+u+1],t[l*e+u+2]),a=[],h=0;for(let l=0;l<r;l++)h+=n*Math.max(o(l,15),o(l,21)),!((s+l)%c&&h<et&&l<r-1)&&(a.push(l),h=0);return a}function nt(i){let[t,s,e,n,r,c,o,a,h]=i,l=[1+t-r-h,1-t+r-h,1-t-r+h,1+t+r+h],u=l.indexOf(Math.max(...l)),m=[[l[0],s+n,e+o,a-c],[s+n,l[1],c+a,e-o],[e+o,c+a,l[2],n-s],[a-c,e-o,n-s,l[3]]],p=Math.hypot(...m[u]);return m[u].map(v=>v/p)}var W=(i,t,s)=>Math.min(Math.max(i,t),s);var V=65536,P=1<<20,D=64,it=["sqrt","sin","cos","tan","asin","acos","atan","atan2","sinh","cosh","tanh","asinh","acosh","atanh","exp","log","pow","hypot"],ot={...Object.fromEntries(it.map(i=>[i,Math[i]])),fmod:(i,t)=>i%t,erf:rt},I=class i{static async from(t){let s=new WebAssembly.Memory({initial:2*P/V}),e=new WebAssembly.Global({value:"i32",mutable:!0},P),n={__linear_memory:s,__stack_pointer:e,...ot},{exports:r}=await WebAssembly.instantiate(t,{env:n});return new i(s,r)}constructor(t,s){Object.assign(this,{memory:t,functions:s,end:P})}reserve(t,s){let e=this.end;this.end+=Math.ceil(s*t.BYTES_PER_ELEMENT/D)*D;let n=this.end-this.memory.buffer.byteLength;return n>0&&this.memory.grow(Math.ceil(n/V)),{place:e,kind:t,length:s,view:()=>new t(this.memory.buffer,e,s)}}call(t,...s){this.functions[t](...s.map(e=>typeof e=="object"?e?.place??0:e))}};function rt(i){if(Math.abs(i)>6)return Math.sign(i);let t=i,s=i;for(let e=3;e<250;e+=2)s+=t*=2*i*i/e;return W(2/Math.sqrt(Math.PI)*Math.exp(-i*i)*s,-1,1)}function G({place:i,stiffness:t,damping:s,most:e},n,r){let c=i.map((a,h)=>t*(a-n[h])-s*r[h]),o=Math.hypot(...c);return o>e?c.map(a=>a*e/o):c}var y=class{static async from(t,s){return new this(await I.from(t),s)}constructor(t,s,e){let{state:n,rotors:r,gains:c,reductions:o}=s,{doubles:a,integers:h}=b(t);Object.assign(this,{engine:t,facts:s,runs:e,row:n+r,tick:0,ended:!0}),this.at={parameters:a(Math.max(e*c.length,1)),reductions:a(e*o),final:a(e*n),end:a(e),status:h(e),clearance:a(e),part:h(e),stop:h(1)},this.asked={t:a(1),state:a(this.row),origin:a(3),shown:a(7)},this.tune({})}tune(t){let s=this.facts.gains.map((e,n)=>t[e]??this.facts.parameters[n]);this.at.parameters.view().set(Array(this.runs).fill(s).flat())}turn(t){this.turned={...this.facts.knobs,...t},this.asked.origin.view().set(this.turned.origin)}fly(t,s){let e={runs:BigInt(t),...s};this.engine.call("kernel",...this.facts.arguments.map(n=>e[n]??this.at[n]??null)),this.ended=this.at.status.view().subarray(0,t).every(n=>n!==0n)}lived(t,s){return this.ended?Math.max(Math.floor(this.at.end.view()[0]/this.facts.period+1e-6)-t+1,0):s}pulled(t,s,e=null){let n=[];for(let r=0;r<t&&!this.ended;r++)n.push(this.pushed(this.#t(s),r===0?e:null));return x(n)}#t(t){let[s,e,n,r]=[0,3,18,21].map(o=>Array.from(this.last.subarray(o,o+3))),{rod:c}=this.facts;return G(t,s.map((o,a)=>o+c*n[a]),e.map((o,a)=>o+c*r[a]))}outcome(t=0){let{at:s}=this,{reductions:e}=this.facts,[n,r,c]=["status","end","part"].map(o=>Number(s[o].view()[t]));return{status:n,end:r,part:c,reductions:Array.from(s.reductions.view().subarray(t*e,(t+1)*e))}}shown(t,s){let{asked:e}=this;return e.t.view()[0]=t,e.state.view().set(s),this.engine.call("shown",e.t,e.state,e.origin,this.at.parameters,e.shown),e.shown.view()}};function b(i){return{doubles:t=>i.reserve(Float64Array,t),integers:t=>i.reserve(BigInt64Array,t)}}function x(i){let t=new Float64Array(i.reduce((s,e)=>s+e.length,0));return i.reduce((s,e)=>(t.set(e,s),s+e.length),0),t}var k=16,F={whole:2e4,tick:2,piece:2e3},Y=200,A=class extends y{constructor(t,s){super(t,s,k);let{doubles:e,integers:n}=b(t);Object.assign(this.at,{starts:e(k*s.state),queue:n(1),steps:n(k)}),Object.assign(this,{state:e(s.state),impulses:e(6),first:e(1),most:0,mostRows:0}),this.turn({})}begin(t){this.state.view().set(t),Object.assign(this,{tick:0,ended:!1,judged:null})}advance(t,s=null){if(this.ended)return new Float64Array(0);let{at:e,facts:n,row:r}=this,{period:c}=n,o=this.tick;this.#s(t),this.#n(t);let a=()=>this.engine.call("own",this.state,this.asked.origin,e.starts);a(),o===0&&this.#e(this.first,e.starts,0),s&&(this.#i(s),a());let h=e.times.view();for(let m=0;m<t;m++)h[m]=(o+1+m)*c;h[t]=1/0,this.#t(1,o,t,t),this.tick=o+t,this.#r(o*c);let l=this.lived(o+1,t),u=o===0?1:0;for(let m=0;m<l;m++)this.#e(B(e.times,m),B(e.samples,n.state*m),u+m);return this.ended||this.state.view().set(this.rows.view().subarray((u+l-1)*r,(u+l-1)*r+n.state)),this.rows.view().slice(0,(u+l)*r)}several(t,s){let e=[];this.#s(s),this.at.times.view()[0]=1/0;for(let n=0;n<t.length;n+=k){let r=t.slice(n,n+k);r.forEach((c,o)=>{this.state.view().set(c),this.engine.call("own",this.state,this.asked.origin,B(this.at.starts,o*this.facts.state))}),this.#t(r.length,0,s,0),e.push(...r.map((c,o)=>super.outcome(o)))}return e}#t(t,s,e,n){let{period:r,exact:{rtol:c,atol:o,max_steps:a}}=this.facts,h=F.whole+F.tick*e,l=e<Y?Math.min(F.piece,a??h):a??h;this.at.queue.view()[0]=0n,this.fly(t,{begin:s*r,until:(s+e)*r,rtol:c,atol:o,max_steps:BigInt(l),time_count:BigInt(n),...this.#o(s,e)})}#e(t,s,e){this.engine.call("row",t,s,this.at.parameters,this.asked.origin,B(this.rows,this.row*e))}#s(t){if(t<=this.most)return;this.most=Math.max(t,2*this.most);let{doubles:s}=b(this.engine),{most:e}=this;Object.assign(this.at,{times:s(e+1),judge_times:s(e+2),bins:s(2*(e+1))})}#n(t){if(t<=this.mostRows)return;this.mostRows=Math.max(t,2*this.mostRows);let{doubles:s}=b(this.engine);this.at.samples=s(this.mostRows*this.facts.state),this.rows=s((this.mostRows+1)*this.row)}#i(t){this.impulses.view().set(t),this.engine.call("strike",this.state,this.impulses,this.state)}#o(t,s){let{judge:e,period:n}=this.facts,{at:r}=this,c=r.judge_times.view(),o=r.bins.view(),a=t===0?0:Math.floor(t/e)+1,h=Math.floor((t+s)/e);for(let u=a;u<=h;u++)c[u-a]=u*e*n;c[Math.max(h-a+1,0)]=1/0;let l=s<Y||h>=o.length?1:h+1;for(let u=0;u<l;u++)o[u]=Math.max(u-a,0);return{bin_count:l,bin_rate:l>1?1/(e*n):0}}#r(t){let{reductions:s,end:e}=super.outcome(),{judged:n}=this,r=this.facts.words.parts.length;if(!n){this.judged=s;return}let[c,...o]=s,a=o.slice(0,r).every(M=>M<0),[h,...l]=n,u=o.slice(0,r).map((M,S)=>Math.max(M,l[S])),[m,p,v]=o.slice(r),[_,R,T]=l.slice(r),j=e>0?t/e:0;this.judged=[a&&Number.isFinite(h)?h:c,...u,m>_?m:_,j*R+(1-j)*p,Math.max(v,T)]}outcome(){return{...super.outcome(),reductions:this.judged}}pushed(t,s){let e=[0,0,0,...t.map(n=>n*this.facts.period)];return this.advance(1,s?e.map((n,r)=>n+s[r]):e)}get last(){return this.state.view()}},B=({place:i,kind:t},s)=>({place:i+s*t.BYTES_PER_ELEMENT});var w=512,at=[0,0,0,0,0,0],O=class extends y{constructor(t,s){super(t,s,s.lanes);let{plant:e,knobs:n,lanes:r}=s,{doubles:c,integers:o}=b(t),{row:a}=this,h=o(1);t.call("context_size",h),Object.assign(this.at,{starts:c(r*a),plant:c(e),seeds:o(r),sample_ticks:o(w+1),judged:o(w+1),rows:o(w+2),samples:c((w+1)*a),context:c(Number(h.view()[0])/8),impulses:c(6*r)}),this.knobs=c(Object.values(n).reduce((l,u)=>l+u.length,0)),this.turn({})}begin(t,s=0,e=null){this.#t([t],s,e??void 0)}#t(t,s,e=new Array(this.facts.rotors).fill(this.facts.knobs.rotor_limits[0])){this.at.starts.view().set(t.flatMap(n=>[...n,...e])),this.at.seeds.view().set(t.map((n,r)=>BigInt(s+r))),this.at.impulses.view().fill(0),Object.assign(this,{tick:0,ended:!1})}turn(t){super.turn(t),this.#e(this.turned)}#e(t){this.knobs.view().set(Object.keys(this.facts.knobs).flatMap(s=>t[s])),this.engine.call("turned",this.knobs,this.at.plant)}advance(t,s=null){let e=[];this.at.impulses.view().set(s??at);for(let n=t;n>0&&!this.ended;n-=w)e.push(this.#s(Math.min(n,w))),this.at.impulses.view().fill(0);return x(e)}several(t,s,e=0){let{runs:n}=this,r=[];for(let c=0;c<t.length;c+=n){let o=t.slice(c,c+n);this.#t(o,e+c);for(let a=s;a>0&&!this.ended;a-=w)this.#s(Math.min(a,w),o.length,0);r.push(...o.map((a,h)=>this.outcome(h)))}return r}#s(t,s=1,e=1){let{at:n,row:r}=this,c=this.tick,o=c===0?0:c+1,a=c+t,h=a-o+1,l=n.sample_ticks.view(),u=n.judged.view(),m=n.rows.view();for(let p=0;p<h;p++)l[p]=BigInt(o+p),u[p]=(o+p)%this.facts.judge===0?1n:0n,m[p]=BigInt(e*p);return m[h]=BigInt(e*h),this.fly(s,{ticks:BigInt(a),sample_count:BigInt(h),row_count:m[h],begun:BigInt(c)}),this.tick=a,n.samples.view().slice(0,e*this.lived(o,h)*r)}pushed(t,s){let{turned:e}=this;this.#e({...e,on_bob:e.on_bob.map((r,c)=>r+t[c])});let n=this.advance(1,s);return this.#e(e),n}get last(){return this.tick===0?this.at.starts.view():this.at.final.view()}};var ct={ideal:A,sampled:O},L=(i,t)=>ct[t.kind].from(i,t);var f,d,K,ht={load({code:i,facts:t}){let s=new Blob([i]).stream().pipeThrough(new DecompressionStream("deflate-raw"));K=new Response(s).arrayBuffer().then(e=>WebAssembly.compile(e)).then(e=>Promise.all([L(e,t),L(e,t)])).then(e=>[f,d]=e)},fly({number:i,asked:t}){let s=performance.now(),e=C(f,t,t.ticks),n=q(f,e,0);return{kind:"flown",number:i,columns:N(f,e,n,0),outcome:f.outcome(),milliseconds:performance.now()-s}},several({number:i,asked:{gains:t,knobs:s,seed:e,ticks:n},starts:r,first:c}){let o=performance.now();return f.tune(t),f.turn(s),{kind:"several",number:i,endings:f.several(r,n,e+c),milliseconds:performance.now()-o}},clear({number:i,starts:t}){let s=new Array(f.facts.rotors).fill(0);return{kind:"clear",number:i,clearances:t.map(e=>f.shown(0,[...e,...s])[4])}},begin({number:i,asked:t,until:s}){return H(i,C(d,t,s),0)},advance({number:i,ticks:t,gains:s,knobs:e,pokes:n,pull:r}){let c=d.tick+1;d.tune(s),d.turn(e);let o=n.reduce(U,null);return H(i,r?d.pulled(t,r,o):d.advance(t,o),c)}};function C(i,{start:t,seed:s,gains:e,knobs:n,pokes:r},c){i.tune(e),i.turn(n),i.begin(t,s);let o=[],a=null;for(let h of r.filter(({tick:l})=>l<c))h.tick>i.tick&&(o.push(i.advance(h.tick-i.tick,a)),a=null),a=U(a,h.impulses);return o.push(i.advance(Math.max(c-i.tick,1),a)),x(o)}var U=(i,t)=>i?i.map((s,e)=>s+t[e]):t;function H(i,t,s){let e=q(d,t,s);return{kind:"piece",number:i,columns:N(d,t,e,s),tick:d.tick,outcome:d.outcome()}}addEventListener("message",async({data:i})=>{try{i.kind!=="load"&&await K;let t=ht[i.kind](i);t&&postMessage(t)}catch(t){postMessage({kind:"error",number:i.number,message:`this browser cannot fly it: ${t.message}`})}});})();\n';var Te=(s,t,e)=>Math.min(Math.max(s,t),e),Ke=(s,t,e)=>s+(t-s)*e,ye=(s,t)=>s.reduce((e,i,n)=>e+i*t[n],0),$e=s=>Math.hypot(...s),ui=s=>{let t=$e(s)||1;return s.map(e=>e/t)},On=s=>Math.acos(Te(s,-1,1))*180/Math.PI;function rd(s,t,e,i,n,r){let o=r,a=1-o;return s.map((l,c)=>(1+2*o)*a*a*l+o*a*a*n*t[c]+o*o*(3-2*o)*e[c]-o*o*a*n*i[c])}function od(s,t,e){let i=ye(s,t),n=i<0?-1:1;i=Math.min(Math.abs(i),1);let r=Math.acos(i),o=Math.sin(r);if(o<1e-6)return ui(s.map((c,h)=>Ke(c,n*t[h],e)));let a=Math.sin((1-e)*r)/o,l=n*Math.sin(e*r)/o;return ui(s.map((c,h)=>a*c+l*t[h]))}function js([s,t,e,i]){return[[1-2*(t*t+e*e),2*(s*t-e*i),2*(s*e+t*i)],[2*(s*t+e*i),1-2*(s*s+e*e),2*(t*e-s*i)],[2*(s*e-t*i),2*(t*e+s*i),1-2*(s*s+t*t)]]}function Qe(s,t){let e=0,i=s.length-1;for(;e<i;){let n=e+i+1>>1;s[n]<=t?e=n:i=n-1}return e}function Ii(s){let t=10**Math.floor(Math.log10(s));return t*[1,2,5,10].find(e=>e*t>=s*(1-1e-9))}var ad=Math.cos(Math.PI/12),Ic=.5,$m=.1,Ym=.4,yo="stands",ld=({gravity:s,rod_length:t})=>Math.sqrt(s/t)||1;function Pc(s,{y:t,y_dot:e,x_dot:i,excess:n}){let{vehicle:r,e3:o}=s,a=o==="up"?1:-1,l=ld(r),c=a*t[2],h=a*e[2]/l,u=Math.hypot(...e)<Ic*l,d=a*(i[2]+r.rod_length*e[2])>$m*l*r.rod_length;return a>0&&n<=0?yo:c>ad&&u?"settles":h<-Ic?"drops":c>0?"catches":h>Ic?"flips":d?"climbs":c<-ad&&u?"hangs":"swings"}function cd(s){let{t}=s,e=[];t.forEach((o,a)=>{let l=Pc(s,{y:s.sample("y",a),y_dot:s.sample("y_dot",a),x_dot:s.sample("x_dot",a),excess:s.columns.excess[a]});l!==e[e.length-1]?.name&&e.push({from:o,name:l})}),e.forEach((o,a)=>o.to=e[a+1]?.from??s.end);let i=Ym/ld(s.vehicle),n=o=>e[o-1]?.name===yo,r=e.filter(({from:o,to:a},l)=>a-o>=i||n(l));return Zm(r.length?r:e.slice(-1),s)}function Zm(s,t){let e=s.filter(({name:i},n)=>i!==s[n-1]?.name).map(({name:i,from:n})=>({name:i,from:n}));return e[0].from=t.start,e.map((i,n)=>({...i,to:e[n+1]?.from??t.end}))}var ns=class{constructor(t){Object.assign(this,{hold:t,all:[],next:0,until:-1/0})}get open(){let t=this.all[this.all.length-1];return t?.end===null?t:null}read(t,e){let{columns:{x:i,x_ref:n,excess:r}}=t,o=t.e3==="up"?1:-1;for(;this.next<t.t.length&&t.t[this.next]<=e;this.next++){let a=3*this.next,l=[0,1,2].map(c=>i[a+c]-n[a+c]);this.#t(t.t[this.next],r[this.next]<=0,Math.hypot(...l),o*i[a+2])}return this.until=e,this}#t(t,e,i,n){let{open:r}=this;if(e){if(!r)return;r.back??=t,t-r.last>this.hold+1e-9&&(r.end=r.back);return}r||this.all.push(r={begin:t,height:n,end:null,distance:0,lost:0}),Object.assign(r,{last:t,back:null,distance:Math.max(r.distance,i),lost:Math.max(r.lost,r.height-n)})}},hd=s=>s<.995?`${(100*s).toFixed(0)} cm`:`${s.toFixed(1)} m`;function ud({all:s},t){let e=s[s.length-1];if(!e||(e.back??t)-e.begin<.05)return"";let{begin:i,back:n,distance:r,lost:o}=e,a=`${((n??t)-i).toFixed(1)} s`;return`${s.length>1?`recovery ${s.length}`:"recovery"}: ${a}${n===null?" so far":""}, ${hd(r)} away, ${hd(o)} lower`}var Jm=2.5,dd=.15,jm=Math.SQRT1_2,Km=Math.cos(Math.PI/4);function Lc(s){let t=Uint8Array.from(atob(s),e=>e.charCodeAt(0));return new Float32Array(t.buffer)}var Fn=class{constructor(t){let{columns:e,...i}=t;Object.assign(this,i),this.columns=Object.fromEntries(Object.entries(e).map(([n,r])=>[n,typeof r=="string"?Lc(r):r])),this.t=this.columns.t,this.rotors=this.vehicle.rotor_positions.length,this.turned=Nc(this)}get start(){return this.t[0]}get end(){return this.t[this.t.length-1]}sample(t,e,i=3){let n=this.columns[t],r=new Array(i);for(let o=0;o<i;o++)r[o]=n[e*i+o];return r}at(t){let e=Te(t,this.start,this.end),i=Math.min(Qe(this.t,e),Math.max(this.t.length-2,0)),n=Math.min(i+1,this.t.length-1),r=this.t[n]-this.t[i],o=r>0?(e-this.t[i])/r:0,[a,l]=[this.sample("quat_xyzw",i,4),this.sample("quat_xyzw",n,4)],[c,h]=[this.sample("y",i),this.sample("y",n)];(Math.abs(ye(a,l))<Km||ye(c,h)<0)&&(o=Math.round(o));let u=(f,p)=>this.sample(f,i,p).map((_,m)=>Ke(_,this.columns[f][n*p+m],o)),d=(f,p)=>rd(this.sample(f,i),this.sample(p,i),this.sample(f,n),this.sample(p,n),r,o);return{t:e,x:d("x","x_dot"),x_dot:u("x_dot",3),quat_xyzw:od(a,l,o),y:ui(d("y","y_dot")),y_dot:u("y_dot",3),thrust:u("thrust",1)[0],rotor_forces:u("rotor_forces",this.rotors),x_ref:u("x_ref",3),excess:u("excess",1)[0],...this.columns.clearance&&{clearance:u("clearance",1)[0]},turned:this.turned[i].map((f,p)=>Ke(f,this.turned[n][p],o))}}get phases(){return this.found??=cd(this)}state(t){return t>=this.end&&this.verdict.state==="failed"?"failed":this.phase(t)===yo?"done":"recovering"}phase(t){return(this.phases.find(({to:e})=>t<e)??this.phases[this.phases.length-1]).name}recoveries(t){return this.counted?.until<=t||(this.counted=new ns(this.hold)),this.counted.read(this,t)}passes(t){if(this.vehicle.mount!=="hub")return!1;for(let e=Qe(this.t,t-dd);e<this.t.length&&this.t[e]<=t+dd;e++){let i=js(this.sample("quat_xyzw",e,4)).map(n=>n[2]);if(Math.abs(ye(i,this.sample("y",e)))<jm)return!0}return!1}series(t,e=0){let i=/^rotor (\d+)$/.exec(t),n={y3:r=>this.columns.y[3*r+2],z3:r=>js(this.sample("quat_xyzw",r,4))[2][2],thrust:r=>this.columns.thrust[r],clearance:r=>this.columns.clearance[r],V:r=>this.columns.V[r],distance:r=>Math.hypot(...this.sample("x",r).map((o,a)=>o-this.columns.x_ref[3*r+a]))}[t]??(r=>this.columns.rotor_forces[this.rotors*r+Number(i[1])-1]);return Float32Array.from({length:this.t.length-e},(r,o)=>n(e+o))}};function Nc(s,t=[]){let{t:e,rotors:i,columns:n,vehicle:r}=s,o=r.weight>0?r.weight/i:1,a=(l,c)=>{let h=n.rotor_forces[l*i+c]/o;return 2*Math.PI*Jm*Math.sign(h)*Math.sqrt(Math.min(Math.abs(h),9))};t.length||t.push(new Array(i).fill(0));for(let l=t.length;l<e.length;l++)t.push(t[l-1].map((c,h)=>c+(e[l]-e[l-1])*(a(l,h)+a(l-1,h))/2));return t}var ni=([s,t,e],i)=>i==="up"?[s,t,e]:[s,-t,-e];function Dc(s,t){if(t==="up")return s;let e=a=>ni(a,t),[i,n,r,o]=s.quat_xyzw;return{...s,x:e(s.x),x_dot:e(s.x_dot),y:e(s.y),y_dot:e(s.y_dot),x_ref:e(s.x_ref),quat_xyzw:[i,-n,-r,o],thrust:-s.thrust}}var ss=s=>t=>typeof t===s,Uc=(s,t=Number.isFinite)=>e=>Array.isArray(e)&&e.length===s&&e.every(t),Qm=s=>t=>Array.isArray(t)&&t.every(s),un=(s,t=()=>!0)=>e=>e!==null&&typeof e=="object"&&!Array.isArray(e)&&Object.entries(e).every(([i,n])=>(Object.hasOwn(s,i)?s[i]:t)(n)),Xi=Uc(3),kn=Number.isFinite,bo=un({},kn),fd=s=>Number.isSafeInteger(s)&&s>=0,Oc={on_vehicle:Xi,on_bob:Xi,gust_on_vehicle:kn,gust_on_bob:kn},tg={start:un({x:Xi,x_dot:Xi,R:Uc(3,Xi),omega:Xi,y:Xi,y_dot:Xi,random:fd}),law:un({name:ss("string"),gains:bo}),vehicle:un({base:ss("string"),mount:ss("string"),rotor_limits:Uc(2)}),plant:un({base:ss("string"),sensors:ss("string"),lag:kn,delay:kn,seed:fd,noise:bo,defects:bo,wind:un(Oc)}),pokes:Qm(s=>un({})(s)&&kn(s.time)&&ss("string")(s.on)&&Xi(s.velocity)),duration:kn,origin:bo},pd=s=>un(tg)(s)&&Object.hasOwn(s,"start")&&Object.hasOwn(s,"law");var eg=250,ig=1500,ng=200,Mo=class{constructor(t,e,i){Object.assign(this,{first:t,changed:e,value:Fc()??structuredClone(t),past:[],future:[]}),this.unreadable=location.hash.length>1&&!Fc(),addEventListener("pagehide",()=>this.keep()),addEventListener("hashchange",({newURL:n})=>{let r=Fc(new URL(n).hash);r&&JSON.stringify(r)!==JSON.stringify(this.value)&&i(r)})}get(t){return t.split(".").reduce((e,i)=>e?.[i],this.value)}put(t,e){this.#e(t);let i=t.split("."),n=i.pop(),r=this.value;for(let o of i)r=r[o]??={};r[n]=e,this.#i()}slide({path:t,put:e},i){this.put(t,e?kc(e,i):i)}replace(t){this.#e(""),this.value=structuredClone(t),this.#i()}undo(){this.#t(this.past,this.future)}redo(){this.#t(this.future,this.past)}#t(t,e){t.length&&(e.push(structuredClone(this.value)),this.value=t.pop(),this.moved=null,this.#i())}#e(t){let e=performance.now(),i=t&&this.moved?.path===t&&e-this.moved.time<ig;this.moved={path:t,time:e},!i&&(this.past=[...this.past.slice(1-ng),structuredClone(this.value)],this.future=[])}adopt(t){this.value.start=t,this.keep()}#i(){clearTimeout(this.waiting),this.waiting=setTimeout(()=>this.keep(),eg),this.changed(this.value)}keep(){location.protocol!=="about:"&&history.replaceState(null,"",`#${encodeURIComponent(JSON.stringify(this.value))}`)}};function kc(s,t){return Array.isArray(s)?s.map(e=>kc(e,t)):s===null||typeof s!="object"?s:"#"in s?s["#"]*t:Object.fromEntries(Object.entries(s).map(([e,i])=>[e,kc(i,t)]))}var Be=({vehicle:s,law:t,plant:e})=>[s?.base,s?.mount??"gimbal",t.name,e?.base,e?.base!=="ideal"&&e?.sensors||"perfect"].join("/");function Fc(s=location.hash){try{let t=JSON.parse(decodeURIComponent(s.slice(1)));return pd(t)?t:null}catch{return null}}var md=600,sg=.001,rg=1e-4,og=["base","lag","delay","noise","wind","sensors","defects","seed"],Bc=["x","x_dot","R","omega","y","y_dot"],Ks=s=>!("random"in s)&&Bc.every(t=>s[t]);function zc(s,t,e=!1){let{plant:i={},vehicle:n={},law:r={},origin:o={}}=s,{wind:a={}}=i,l=t.knobs.defects,c={lag:So(i.lag),delay:So(Te(i.delay,0,t.delay)),noise:i.noise&&t.noise.map(h=>i.noise[h]??0),defects:i.defects&&t.defects.map((h,u)=>i.defects[h]??l[u]),on_vehicle:a.on_vehicle,on_bob:a.on_bob,gust_on_vehicle:So(a.gust_on_vehicle),gust_on_bob:So(a.gust_on_bob),rotor_limits:n.rotor_limits,origin:e?["x","y","z"].map(h=>o[h]??0):void 0};return{gains:r.gains??{},knobs:Object.fromEntries(Object.entries(c).filter(([,h])=>h?.every(Number.isFinite)))}}var So=s=>s===void 0?void 0:[s];function wo(s){let t=ui(s.y),e=ye(t,s.y_dot),i={...s,y:t,y_dot:s.y_dot.map((n,r)=>n-e*t[r])};return Bc.flatMap(n=>i[n].flat())}function Gc(s,t,{masses:e}){let i=t.map(n=>n*e[s]);return s==="bob"?[0,0,0,...i]:[...i,0,0,0]}function Eo(s,t,e){let i=o=>Math.round(o/t.period),n=(s.pokes??[]).map(({time:o,on:a,velocity:l})=>({tick:i(o),impulses:Gc(a,l,t)})),r=n.length?n[n.length-1].tick:0;return{...zc(s,t),start:wo(s.start),seed:s.plant?.seed??e,pokes:n,ticks:r+i(s.duration)}}function Ao(s,t){let{start:e,duration:i,pokes:n=[]}=s,{masses:r,period:o}=t,a=Bc.find(l=>!e[l]);return a?`start.${a}: expected numbers, got nothing`:$e(e.y)<sg?`start.y: expected a direction, got one of length ${$e(e.y)}`:cg(e.R)?i>=o?n.some(({on:l})=>!Object.hasOwn(r,l))?`pokes: expected one of ${Object.keys(r).join(", ")}`:n.some(({time:l},c)=>c?l<=n[c-1].time:l<0)?"pokes: expected increasing times":i+(n.at(-1)?.time??0)>md?`duration: expected at most ${md} s of flight, pokes included`:Vc(s,t):`duration: expected at least ${o} s`:"start.R: expected a rotation matrix"}var Vc=({law:s,plant:t,vehicle:e},i)=>ag(s.gains,i)||(i.kind==="ideal"?"":lg(t,e,i.delay));function ag(s={},{gains:t,bounds:e}){let i=t.findIndex((h,u)=>s[h]<=e[u].above||s[h]<e[u].at_least||s[h]>e[u].at_most);if(i<0)return"";let n=t[i],r=s[n],{above:o,at_least:a,at_most:l}=e[i],c=r>l?`at most ${l}`:o===void 0?`at least ${a}`:`more than ${o}`;return`law.gains.${n}: expected ${c}, got ${r}`}function lg({lag:s,delay:t,noise:e,defects:i,wind:{gust_on_vehicle:n,gust_on_bob:r}={}}={},{rotor_limits:[o,a]=[0,1]}={},l){let c={lag:s,delay:t,...e,...i,gust_on_vehicle:n,gust_on_bob:r},h=Object.keys(c).find(u=>c[u]<0);return h?`plant.${h}: expected at least 0, got ${c[h]}`:t>Math.max(l,+l.toPrecision(3))?`plant.delay: expected at most ${l} s, got ${t}`:o>=0&&o<a?"":`vehicle.rotor_limits: expected 0 <= least < largest, got ${o}, ${a}`}function Hc({law:s,plant:t={}},{gains:e}){let i=(a={},l)=>Object.keys(a).find(c=>!l.includes(c)),n=i(s.gains,e);if(n)return`law.gains.${n}`;if(t.base==="ideal")return"";let r=i(t.wind,Object.keys(Oc)),o=r?`wind.${r}`:i(t,og);return o?`plant.${o}`:""}var Qs=(s,t)=>s.vehicle?.rotor_limits?"vehicle.rotor_limits":Hc(s,t);function cg([s,t,e]){let i=[s[1]*t[2]-s[2]*t[1],s[2]*t[0]-s[0]*t[2],s[0]*t[1]-s[1]*t[0]];return[$e(s)-1,$e(t)-1,ye(s,t),...i.map((n,r)=>n-e[r])].every(n=>Math.abs(n)<rg)}function tr({status:s,end:t,part:e,reductions:i},{words:n,e3:r},o=0){let[a,...l]=i,c=l.slice(0,n.parts.length),h=l[n.parts.length],u=b=>`${+(Math.round(100*b)/100).toPrecision(3)} m`,d=r==="up",f=d?`excursion ${u(h)}`:`vehicle ${o>=0?"fell":"rose"} ${u(Math.abs(o))}`,p=n.status[s];if(p!=="completed"){let[b,E]=p==="collided"&&n.touched[e]||[null,""];return{words:`${p} ${t>0?`after ${+t.toPrecision(3)} s`:"at the start"}${E&&`, ${E}`}`,good:!1,state:"failed",settling:null,excursion:null,reason:E||n.reasons[s],part:b,cause:p}}let _=c.map(b=>b>=t-n.hold-1e-9),m=n.parts[_.indexOf(!0)];return{words:`${m?`${n.missed[m]} during the last second`:`${d?n.pose:n.hangs} after ${a.toFixed(1)} s`}, ${f}`,good:!m,state:m?"failed":d?"done":"recovering",settling:m?null:a,excursion:h,reason:"",part:null,cause:m??""}}var To={least:2,first:8,most:64,time:50},hg=6,gd;function er(s,t,e){s.delete(t),s.set(t,e);for(let[i,n]of s){if(s.size<=hg)break;n?.end(),s.delete(i)}}var dn=class{constructor({engine:t,offer:e,runs:i},n){let{code:r,...o}=t,{columns:a,...l}=i[0];Object.assign(this,{facts:o,offer:e,told:n,record:l,number:0,waiting:null,busy:!1}),gd??=URL.createObjectURL(new Blob([sd],{type:"text/javascript"})),this.worker=new Worker(gd),this.worker.addEventListener("message",({data:c})=>this.#s(c)),this.worker.postMessage({kind:"load",code:Uint8Array.from(atob(r),c=>c.charCodeAt(0)),facts:o})}ask(t,e={},i=++this.number){if(this.mapping=null,t==="stop")return i;let n=this.whole(e.setting),r=this.#t(n)||Ao(n,this.facts);return r?queueMicrotask(()=>this.told({kind:"error",number:i,field:"",message:r})):t==="fly"?(this.waiting={number:i,setting:n},this.#n()):this.#e({number:i,setting:{...n,pokes:[]},done:0,size:To.first}),i}#t(t){let{first:e,vehicles:i}=this.offer;if(!e||i)return"";let n=Be(t)===Be(e)?Hc(t,this.facts):Be(t);return n&&`setting: expected law, vehicle, plant and gains of this page, got ${n}`}#e(t){let{number:e,setting:i,done:n,size:r}=t,o=this.directions.slice(n,n+r);this.mapping={...t,rods:o,done:n+o.length};let a=o.map(l=>wo({...i.start,y:l,y_dot:[0,0,0]}));this.worker.postMessage({kind:"several",number:e,asked:Eo(i,this.facts,this.offer.seed),starts:a,first:n})}#i({number:t,endings:e,milliseconds:i}){let{mapping:n}=this,r=this.directions.length;if(t!==n?.number)return;let o=e.map(h=>tr(h,this.facts)),a=h=>o.map(u=>u[h]);this.told({kind:"map",number:t,total:r,done:n.done,y:n.rods,settling:a("settling"),cause:a("cause")});let l=Math.round(e.length*To.time/Math.max(i,1)),c=Te(l,To.least,To.most);this.mapping===n&&n.done<r&&this.#e({...n,size:c})}clear(t,e,i){let{start:n}=this.whole(t),r=++this.number;this.clearing={number:r,done:i},this.worker.postMessage({kind:"clear",number:r,starts:e.map(o=>wo({...n,y:o,y_dot:[0,0,0]}))})}get directions(){return this.spread??=ug(Array.from(Lc(this.offer.directions)))}begin(t,e,i){this.flown=i,this.begun=++this.number,this.worker.postMessage({kind:"begin",number:this.begun,asked:Eo(this.whole(t),this.facts,this.offer.seed),until:e})}rebuilds(){return!1}advance(t){this.worker.postMessage({kind:"advance",number:this.begun,...t})}end(){this.worker.terminate()}whole(t){let{random:e,...i}=t.start,{randoms:n}=this.offer;return e===void 0?t:{...t,start:{...n[e%n.length],...i}}}#n(){if(this.busy||!this.waiting)return;let{number:t,setting:e}=this.waiting;Object.assign(this,{busy:!0,asked:e,waiting:null}),this.worker.postMessage({kind:"fly",number:t,asked:Eo(e,this.facts,this.offer.seed)})}#s(t){if(t.kind==="error"){this.busy=!1,this.told({...t,field:""}),this.#n();return}if(t.kind==="several"){this.#i(t);return}if(t.kind==="clear"){t.number===this.clearing.number&&this.clearing.done(t.clearances);return}if(t.kind==="piece"){t.number===this.begun&&this.flown?.(t);return}let{asked:e}=this,{number:i,columns:n,outcome:r,milliseconds:o}=t,{x:a}=n,l=tr(r,this.facts,a[a.length-1]-a[2]);this.busy=!1,this.told({kind:"flight",number:i,milliseconds:o,verdict:l,start:e.start,sliders:this.sliders(e),run:{...this.record,columns:n,verdict:l,completed:r.status===0,gains:dg(e,this.record)}}),this.#n()}sliders(t){return this.offer.sliders.map(e=>{let i=e.path.split(".").reduce((n,r)=>n?.[r],t);return i===void 0?e:{...e,value:xd(e.put,i)}})}},ug=s=>Array.from({length:s.length/3},(t,e)=>s.slice(3*e,3*e+3));function xd(s,t){if(s==null)return t;if("#"in Object(s))return t/s["#"];for(let e of Object.keys(Object(s))){let i=xd(s[e],t[e]);if(typeof s[e]=="object"&&Number.isFinite(i))return i}return NaN}function dg({law:s},{gains:t}){return t.map(([e,i])=>[e,e in s.gains?String(+s.gains[e].toPrecision(4)):i])}var Ro=class{constructor(t,e){Object.assign(this,{told:t,state:e,number:0,last:new Map}),this.#e()}reserve(){return++this.number}ask(t,e={},i=this.reserve()){let n={kind:t,number:i,...e};return t==="stop"?this.last.delete("map"):this.last.set(t,n),this.#t(n),n.number}#t(t){this.socket.readyState===WebSocket.OPEN&&this.socket.send(JSON.stringify(t))}#e(){let t=new URL("socket",location.href);t.protocol=location.protocol==="https:"?"wss:":"ws:",t.hash="",this.socket=new WebSocket(t),this.socket.addEventListener("open",()=>{this.state(!0);for(let e of this.last.values())this.#t(e)}),this.socket.addEventListener("message",e=>this.told(JSON.parse(e.data))),this.socket.addEventListener("close",()=>{this.state(!1),setTimeout(()=>this.#e(),700)})}};var fg=150,Co=class{constructor(t,e){Object.assign(this,{told:t,engines:new Map,known:null}),this.link=new Ro(i=>this.#n(i),i=>e(i?"":"no connection to the server"))}ask(t,e={}){if(t!=="fly")return this.link.ask(t,e);let i=this.link.reserve();return clearTimeout(this.resting),this.asked=structuredClone(e.setting),this.confirm=()=>this.link.ask("fly",e,i),this.#t(i,e.setting)?this.flying=i:this.confirm(),i}#t(t,e){let{local:i}=this;if(!i||!Ks(e.start)||!this.#e(e))return!1;let n=this.#i(e);return Ao(n,i.facts)?!1:(i.ask("fly",{setting:n},t),!0)}get local(){let t=this.known?.key===Be(this.asked)&&this.engines.get(this.known.key);return t&&!_d(this.asked,t.facts)?t:null}#e({law:t}){return this.known.sliders.every(({path:e,allowed:i})=>{let n=t.gains?.[e.slice(10)];return!i||n===void 0||n>=i[0]&&n<=i[1]})}#i(t){let e=this.known.sliders.filter(({path:n})=>n.startsWith("law.gains.")).map(({path:n,value:r})=>[n.slice(10),r]),i=Object.fromEntries(e.filter(([n])=>!(n in this.known.gains)));return{...t,law:{...t.law,gains:{...i,...t.law.gains}}}}#n(t){if(t.kind==="engine"){let{last:e}=this.link;t.number===e.get("engine")?.number&&e.delete("engine"),er(this.engines,t.key,t.engine&&this.#s(t)),this.#o(),this.told({kind:"able"});return}t.kind==="flight"&&this.#r(t),this.told(t)}#s({engine:t,key:e,sliders:i}){return new dn({engine:t,offer:{sliders:i,seed:0},runs:[{}]},n=>{n.kind==="flight"?(n.number===this.flying&&(this.resting=setTimeout(this.confirm,fg)),this.told({...n,kind:"preview"})):(this.engines.set(e,null),this.confirm(),this.told({kind:"able"}))})}#r({number:t,sliders:e,run:i}){let{setting:n,number:r}=this.link.last.get("fly");if(t!==r)return;let o=Be(n),{columns:a,...l}=i;if(this.known={key:o,sliders:e,gains:n.law.gains,record:l},this.engines.has(o))er(this.engines,o,this.engines.get(o));else{this.engines.set(o,null);let{vehicle:c,law:h,plant:u}=n,d={vehicle:{base:c.base,mount:c.mount},law:{name:h.name,gains:{}},plant:{base:u.base,sensors:u.sensors}};this.link.ask("engine",{key:o,setting:{...n,...d,pokes:[]}})}this.#o()}#o(){let{local:t,known:e}=this;if(!t)return;let i=Object.fromEntries(t.offer.sliders.map(({path:n,value:r})=>[n,r]));t.record=e.record,t.offer.sliders=e.sliders.map(n=>({...n,value:i[n.path]}))}get facts(){return this.local?.facts}rebuilds(t){return _d(t,this.facts)}begin(t,e,i){this.local.begin(this.#i(t),e,i)}advance(t){this.local.advance(t)}clear(t,e,i){Ks(t.start)&&this.local?.clear(t,e,i)}whole(t){return t}sliders(t){return this.local.sliders(t)}},_d=(s,t)=>!!(s.plant?.sensors&&s.plant.delay!==void 0||Qs(s,t)||Vc(s,t));var Io=`:root { color-scheme: light; font: 14px/1.45 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", sans-serif; }
@media (min-width: 2400px) and (min-height: 1200px) { :root { font-size: 19px; } } /* letters that are read from where such a screen is seen whole */
@media (min-width: 3200px) and (min-height: 1600px) { :root { font-size: 26px; } }
:root[data-theme="dark"] { color-scheme: dark; }
* { box-sizing: border-box; }
[hidden] { display: none !important; }
body { margin: 0; background: var(--paper); color: var(--ink); }
main {
  display: grid; height: 100vh; height: 100dvh; overflow: hidden;
  grid-template: auto minmax(0, 1fr) auto / minmax(0, 1fr) clamp(22.85714rem, 33vw, 34rem);
  grid-template-areas: "head head" "scene plots" "foot foot";
}
header { grid-area: head; display: flex; flex-wrap: wrap; align-items: baseline; gap: 0.14286rem 2rem; padding: 0.85714rem 1.42857rem 0.71429rem; }
h1 { margin: 0; font-size: 1.214rem; font-weight: 650; letter-spacing: -0.01em; }
.legend { display: flex; flex-wrap: wrap; gap: 0.14286rem 1.71429rem; }
.legend p { margin: 0; color: var(--muted); display: flex; flex-wrap: wrap; align-items: center; gap: 0 0.57143rem; }
.legend strong { color: var(--ink); font-weight: 600; margin-left: 0.28571rem; }
.legend sub { font-size: 0.75em; line-height: 0; }
.verdict { margin: 0; font-style: normal; padding-left: 1.21429rem; position: relative; font-variant-numeric: tabular-nums; color: var(--ink); }
.verdict::before { content: ""; position: absolute; left: 0; top: 0.38em; box-sizing: border-box; width: 0.71429rem; height: 0.71429rem; border-radius: 50%; background: var(--line); }
.verdict.done::before { background: var(--done); }
.verdict.recovering::before { border: 0.14286rem solid var(--recovering); background: linear-gradient(to right, var(--recovering) 50%, transparent 50%); }
.verdict.failed::before { border-radius: 0.07143rem; background: var(--failed); clip-path: polygon(20% 0, 50% 30%, 80% 0, 100% 20%, 70% 50%, 100% 80%, 80% 100%, 50% 70%, 20% 100%, 0 80%, 30% 50%, 0 20%); }
.verdict.failed { color: var(--failed); }
.legend .detail:empty { display: none; }
.legend .only svg, .legend .only strong { display: none; }
.legend line { stroke: var(--ink); stroke-width: 2; }
.legend .ghost line { stroke: var(--ghost); }
.scene { grid-area: scene; position: relative; min-height: 0; overflow: hidden; margin-left: 0.85714rem; border-radius: 0.85714rem; background: var(--sky); }
.picture { position: absolute; inset: 0; width: 100%; height: 100%; display: block; touch-action: none; cursor: grab; }
.picture:active { cursor: grabbing; }
.filming .picture { object-fit: contain; }
.filming :is(.view, .height, .near, .handle, .coil, .newtons) { visibility: hidden; }
.scene.none .picture { display: none; }
.view, .note, .low { position: absolute; margin: 0; color: var(--muted); font-size: 0.893rem; pointer-events: none; }
.view ~ .view { border: solid var(--line); border-width: 0 0 0 0.07143rem; }
.said { position: absolute; left: 1.14286rem; top: 0.85714rem; max-width: calc(100% - 9.42857rem); font-variant-numeric: tabular-nums; }
.said p { margin: 0 0 0.14286rem; position: relative; }
.said::before, .key::before { content: ""; position: absolute; inset: -0.28571rem -0.57143rem; border-radius: 0.57143rem; background: var(--sky); opacity: 0.94; }
.key::before { z-index: -1; inset: 0 -0.28571rem; opacity: 0.75; }
.low { z-index: 0; }
.motion, .recovered, .ended, .near, .height { text-shadow: 0 0 0.21429rem var(--sky), 0 0 0.21429rem var(--sky), 0 0 0.21429rem var(--sky); }
.motion b { margin-right: 0.42857rem; font-size: 1.214rem; }
.motion .done { color: var(--done); }
.motion .recovering { color: var(--recovering); }
.motion .failed { color: var(--failed); }
.ended { color: var(--failed); font-weight: 600; }
.compass { position: absolute; right: 0.28571rem; top: 0.28571rem; }
.low { right: 1rem; bottom: 0.71429rem; left: 0.71429rem; }
.key { margin: 0.42857rem 0 0 auto; width: fit-content; position: relative; display: flex; flex-wrap: wrap; justify-content: flex-end; gap: 0 1rem; font-size: 0.857rem; }
.key i { display: inline-block; width: 0.64286rem; height: 0.64286rem; border-radius: 50%; margin-right: 0.35714rem; }
.near { position: absolute; white-space: nowrap; margin: 0; padding: 0.42857rem 0.71429rem; display: flex; align-items: end; border: 0.10714rem solid var(--line); border-radius: 0.71429rem; color: var(--ink); font-weight: 600; font-variant-numeric: tabular-nums; pointer-events: none; }
.near span { padding: 0 0.35714rem; margin: 0 -0.35714rem; border-radius: 0.42857rem; background: color-mix(in srgb, var(--sky) 85%, transparent); }
.note { inset: 45% 10% auto; text-align: center; }
.height { position: absolute; left: 0.6rem; top: -0.7em; color: var(--muted); font-size: 0.857rem; pointer-events: none; white-space: nowrap; }
.invite { padding: 0.35714rem 1rem; border-radius: 7.07143rem; background: var(--ink); color: var(--paper); font-size: 1rem; font-weight: 600; white-space: nowrap; pointer-events: none; }
.scene > .invite { position: absolute; left: 50%; top: 16%; transform: translateX(-50%); margin: 0; }
.scene > .invite.under { top: auto; bottom: 20%; }
.plots { grid-area: plots; display: flex; flex-direction: column; gap: 0.42857rem; min-height: 0; padding: 0 0.85714rem; overflow: hidden auto; }
.plot { margin: 0; flex: 1 1 0; min-height: 8rem; display: flex; flex-direction: column; }
.plot.wide { flex-grow: 1.5; min-height: 10.71429rem; } /* many curves, still told apart where the column is short */
.plot figcaption { display: flex; flex-wrap: wrap; justify-content: space-between; gap: 0 0.85714rem; padding: 0 0.85714rem 0 3.28571rem; font-size: 0.893rem; }
.what { font-weight: 600; }
.values { display: flex; flex-wrap: wrap; gap: 0 0.57143rem; font-variant-numeric: tabular-nums; }
.wide .values { gap: 0 0.35714rem; }
.wide .values output { min-width: 2.2em; }
.wide .mark { width: 0.85714rem; margin-right: 0.14286rem; }
.values > span { display: inline-flex; align-items: baseline; }
.values b { font-weight: 600; margin-right: 0.28571rem; white-space: nowrap; }
.values sub { font-size: 0.75em; line-height: 0; }
.mark { flex: none; width: 1.14286rem; height: 0.71429rem; margin-right: 0.28571rem; align-self: center; overflow: visible; fill: var(--tone); stroke: var(--tone); stroke-width: 1.8; }
.mark circle, .mark polygon { stroke: none; }
.values output { display: inline-block; min-width: 2.7em; text-align: right; color: var(--muted); }
.portrait { margin: 0; }
.portrait :is(button, .globe) { pointer-events: auto; }
.globe { position: relative; border-radius: 50%; width: clamp(9.42857rem, 22vmin, 17rem); aspect-ratio: 1; cursor: pointer; touch-action: manipulation; }
.globe::before { content: ""; position: absolute; inset: 0 -0.28571rem; border-radius: 0.85714rem; background: var(--sky); opacity: 0.6; }
.globe canvas { position: absolute; inset: 0; width: 100%; height: 100%; }
.globe i { position: absolute; left: 0; top: 0; pointer-events: none; will-change: transform; }
.globe .rod { width: 0.85714rem; height: 0.85714rem; margin: -0.42857rem 0 0 -0.42857rem; border-radius: 50%; background: var(--rod); border: 0.10714rem solid var(--paper); }
.globe .rod.ghost { background: var(--paper); border: 0.17857rem solid var(--ghost); }
.globe .hand { width: 0.07143rem; height: 0.21429rem; margin-top: -0.10714rem; transform-origin: 0 50%; background: var(--ink); }
.portrait figcaption { display: flex; flex-wrap: wrap; align-items: center; gap: 0.57143rem; color: var(--muted); font-size: 0.893rem; white-space: nowrap; font-variant-numeric: tabular-nums; text-shadow: 0 0 0.21429rem var(--sky), 0 0 0.21429rem var(--sky), 0 0 0.21429rem var(--sky); }
.portrait button { flex: none; padding: 0.14286rem 0.5rem; font-size: 0.893rem; min-width: 2rem; }
.area { position: relative; flex: 1; min-height: 0; cursor: ew-resize; touch-action: pan-y; }
.area canvas { position: absolute; inset: 0; width: 100%; height: 100%; }
.cursor { position: absolute; top: 0.42857rem; bottom: 1.42857rem; left: -0.05357rem; width: 0.10714rem; background: var(--ink); pointer-events: none; will-change: transform; }
footer { grid-area: foot; display: flex; flex-wrap: wrap; align-items: center; gap: 0.57143rem 1.42857rem; padding: 0.71429rem 1.42857rem 0.85714rem; }
.player { flex: 1 1 24.28571rem; display: flex; align-items: center; gap: 0.85714rem; }
button, select { font: inherit; color: inherit; background: var(--panel); border: 0.07143rem solid var(--line); border-radius: 0.57143rem; cursor: pointer; }
button:hover, select:hover { border-color: var(--muted); }
:focus-visible { outline: 0.14286rem solid var(--trail); outline-offset: 0.14286rem; }
.play { flex: none; width: 3rem; height: 3rem; padding: 0; border: 0; border-radius: 50%; background: var(--ink); color: var(--paper); }
.play svg { width: 1.71429rem; height: 1.71429rem; fill: currentColor; display: block; margin: auto; }
.time { flex: none; min-width: 8.2em; text-align: right; font-variant-numeric: tabular-nums; }
.track { position: relative; flex: 1; min-width: 4.28571rem; display: flex; }
.touch { position: absolute; left: calc(0.57143rem + (100% - 1.14286rem) * var(--at)); top: 0.07143rem; width: 0; height: 0; margin-left: -0.42857rem; border: solid transparent; border-width: 0.64286rem 0.42857rem 0; border-top-color: var(--failed); }
.line { flex: 1; min-width: 0; height: 2rem; margin: 0; appearance: none; background: none; cursor: pointer; }
.line::-webkit-slider-runnable-track { height: 0.28571rem; border-radius: 0.14286rem; background: linear-gradient(to right, var(--ink) var(--done), var(--line) var(--done)); }
.line::-webkit-slider-thumb { appearance: none; width: 1.14286rem; height: 1.14286rem; margin-top: -0.42857rem; border-radius: 50%; background: var(--ink); border: 0; }
.line::-moz-range-track { height: 0.28571rem; border-radius: 0.14286rem; background: var(--line); }
.line::-moz-range-progress { height: 0.28571rem; border-radius: 0.14286rem; background: var(--ink); }
.line::-moz-range-thumb { width: 1.14286rem; height: 1.14286rem; border: 0; border-radius: 50%; background: var(--ink); }
.speed { flex: none; color: var(--muted); font-size: 0.929rem; }
select { padding: 0.35714rem 0.42857rem; }
.choices { display: flex; flex-wrap: wrap; gap: 0.57143rem; }
.choice { display: flex; }
.choice button { padding: 0.42857rem 0.78571rem; border-radius: 0; margin-left: -0.07143rem; white-space: nowrap; font-size: 0.929rem; }
.choice button:first-child { border-radius: 0.57143rem 0 0 0.57143rem; margin-left: 0; }
.choice button:last-child { border-radius: 0 0.57143rem 0.57143rem 0; }
.choice button:only-child { border-radius: 0.57143rem; }
.choice select { margin-left: -0.07143rem; border-radius: 0 0.57143rem 0.57143rem 0; font-size: 0.929rem; }
.choice:has(select) button { border-radius: 0.57143rem 0 0 0.57143rem; }
.choice button[aria-pressed="true"] { background: var(--ink); color: var(--paper); border-color: var(--ink); }
@media (min-width: 761px) and (max-width: 1080px) and (orientation: portrait) {
  main { grid-template: auto minmax(0, 1.1fr) auto minmax(0, 1fr) / minmax(0, 1fr); grid-template-areas: "head" "scene" "foot" "plots"; }
  .scene { margin: 0 0.85714rem; }
  .plots { display: grid; grid-template-columns: repeat(2, minmax(0, 1fr)); grid-auto-rows: minmax(10.71429rem, 1fr); padding: 0 0.85714rem 0.57143rem; }
  .plots:has(> :nth-child(5)) { grid-template-columns: repeat(3, minmax(0, 1fr)); grid-auto-flow: dense; }
  .plots:has(> :nth-child(5)):not(:has(> :nth-child(6))) > .wide { grid-column: span 2; }
  footer { gap: 0.57143rem 1rem; padding: 0.57143rem 1.14286rem; }
  .choice button { padding: 0.42857rem 0.57143rem; }
}
@media (prefers-reduced-motion: reduce) { *, ::before, ::after { transition: none !important; animation: none !important; scroll-behavior: auto !important; } }
@media (max-width: 760px) {
  main { height: auto; min-height: 100dvh; overflow: visible; grid-template: auto 52vh auto auto / minmax(0, 1fr); grid-template-areas: "head" "scene" "foot" "plots"; }
  header { padding: 0.85714rem 1.14286rem 0.57143rem; }
  .scene { margin: 0 0.57143rem; }
  .picture { touch-action: pan-y; }
  footer { position: sticky; top: 0; z-index: 1; padding: 0.57143rem 0.85714rem; background: var(--paper); }
  .player { flex: 1 1 100%; min-width: 0; gap: 0.71429rem; }
  .time { min-width: 0; }
  .key { gap: 0 0.71429rem; font-size: 0.786rem; }
  .scene > .invite:not(.under) { top: max(16%, 7.57143rem); } /* below words and compass */
  .said { left: 0.85714rem; top: 0.57143rem; max-width: calc(100% - 8rem); font-size: 0.857rem; line-height: 1.3; }
  .portrait button { min-width: 2.42857rem; min-height: 2.28571rem; }
  .view ~ .view { border-width: 0.07143rem 0 0; }
  .speed span { display: none; }
  select { padding: 0.57143rem 0.42857rem; }
  .choice button { padding: 0.57143rem 0.71429rem; }
  .plots { overflow: visible; padding: 0.28571rem 0.28571rem 1.14286rem; gap: 0.71429rem; }
  .plot { flex: none; }
  .area { flex: none; height: 9.28571rem; }
}
@media (max-width: 380px) { .said { max-width: calc(100% - 7.14286rem); font-size: 0.786rem; } } /* one line, above the bob */
.sheet { max-width: min(44rem, 100vw - 1.71429rem); max-height: calc(100dvh - 1.71429rem); padding: 1.42857rem 1.71429rem; border: 0.07143rem solid var(--line); border-radius: 1rem; background: var(--paper); color: var(--ink); }
.sheet::backdrop { background: rgb(0 0 0 / 0.55); }
.sheet header { display: flex; align-items: center; justify-content: space-between; gap: 1.42857rem; margin: 0 0 0.85714rem; padding: 0; }
.sheet h2 { margin: 0; font-size: 1.214rem; }
.sheet .close { min-height: 3.14286rem; padding: 0.57143rem 1.28571rem; }
.sheet dl { display: grid; grid-template-columns: max-content minmax(0, 1fr); gap: 0.42857rem 1.28571rem; margin: 0; }
.sheet dt { max-width: 14em; font-weight: 600; }
.sheet dd { margin: 0; }
@media (max-width: 760px) { .sheet dl { grid-template-columns: minmax(0, 1fr); gap: 0; } .sheet dd { margin-bottom: 0.57143rem; } }
@media (pointer: coarse), (max-width: 760px) { /* what a finger finds */
  :is(button, select) { min-height: 3.14286rem !important; min-width: 3.14286rem !important; }
  input[type="range"] { height: 3.14286rem !important; }
}
`;var vd=`main.lab { grid-template: auto auto minmax(0, 1fr) auto / minmax(0, 1fr) clamp(17.85714rem, 25vw, 30rem); grid-template-areas: "head head" "bar bar" "scene plots" "foot foot"; }
main.lab.tuned { grid-template-columns: 21rem minmax(0, 1fr) clamp(17.85714rem, 25vw, 30rem); grid-template-areas: "head head head" "bar bar bar" "panel scene plots" "panel foot foot"; }
main.lab[data-tab="map"] { grid-template-areas: "head head" "bar bar" "map map" "map map"; }
main.lab.tuned[data-tab="map"] { grid-template-areas: "head head head" "bar bar bar" "panel map map" "panel map map"; }
.lab[data-tab="map"] > :is(.scene, .plots, footer) { visibility: hidden; position: absolute; width: 0; height: 0; overflow: hidden; }
.bar { grid-area: bar; display: flex; flex-wrap: wrap; align-items: center; gap: 0.42857rem 1.71429rem; padding: 0 1.42857rem 0.71429rem 0.85714rem; }
.five { display: flex; flex-wrap: wrap; align-items: center; gap: 0.57143rem; }
.five :is(button, select) { min-height: 2.85714rem; padding: 0.42857rem 1rem; }
.five label { display: flex; align-items: center; gap: 0.57143rem; }
.five button:is([aria-pressed="true"], [aria-expanded="true"]) { background: var(--ink); color: var(--paper); border-color: var(--ink); }
.five button:disabled { color: var(--muted); cursor: default; }
.handle .invite { position: absolute; left: calc(100% + 0.14286rem); top: 50%; transform: translateY(-50%); }
@media (max-width: 600px) { .handle .invite { top: calc(100% + 0.85714rem); transform: none; width: 7em; white-space: normal; border-radius: 1rem; line-height: 1.25; }
  .handle.deep .invite { top: auto; bottom: 50%; } } /* below the compass, or where the bob hangs, above the legend */
.lab header { align-items: center; }
.lab .legend { display: none; }
.lab header .verdict { font-weight: 600; min-height: 1.45em; }
.busy { position: absolute; z-index: 1; left: 50%; top: 5.4rem; /* below the words */ transform: translateX(-50%); margin: 0; padding: 0.35714rem 1rem; border-radius: 7.07143rem; background: var(--ink); color: var(--paper); font-size: 0.929rem; white-space: nowrap; }
.panel { grid-area: panel; overflow: hidden auto; padding: 0 1.14286rem 1.14286rem 1.42857rem; scrollbar-width: thin; }
.panel section { padding: 0.71429rem 0 0.85714rem; border-top: 0.07143rem solid var(--line); }
.panel section:first-child { border-top: 0; padding-top: 0.14286rem; }
.panel h2 { display: flex; align-items: baseline; gap: 0.57143rem; margin: 0 0 0.42857rem; font-size: 0.929rem; font-weight: 650; }
.panel h2 small { font-weight: 400; color: var(--muted); font-variant-numeric: tabular-nums; }
main:not(.running) .has-place { display: none; }
.panel .small { border: 0; padding: 0 0.14286rem; background: none; color: var(--muted); font-size: 0.893rem; font-weight: 400; text-decoration: underline; text-underline-offset: 0.14286rem; }
.panel .small:disabled { color: var(--muted); text-decoration: none; opacity: 0.75; cursor: default; }
.panel .small:hover:enabled { color: var(--ink); }
.panel :is(.reset, .undo) { margin-left: auto; }
.stale :is(.picture, .view, .low, .plot) { opacity: 0.35; filter: grayscale(0.7); }
.notice { position: absolute; left: 1.14286rem; right: 8.85714rem; top: 2.85714rem; z-index: 1; margin: 0; padding: 0.71429rem 1rem; border-radius: 0.71429rem; border: 0.07143rem solid var(--failed); background: var(--panel); color: var(--ink); font-size: 0.964rem; }
.notice button { margin-left: 0.57143rem; padding: 0.21429rem 0.71429rem; font-size: 0.929rem; }
.row { display: flex; align-items: center; justify-content: space-between; gap: 0.71429rem; margin: 0.28571rem 0; font-size: 0.929rem; }
.row select { flex: none; width: min(12.71429rem, 100% - 5.57143rem); font-size: 0.929rem; padding: 0.28571rem 0.42857rem; }
.row.two > * { flex: 1; }
.panel button, .panel .save { font-size: 0.929rem; padding: 0.42857rem 0.57143rem; }
.panel .save { text-align: center; border: 0.07143rem solid var(--line); border-radius: 0.57143rem; color: inherit; text-decoration: none; background: var(--panel); }
.panel button[aria-pressed="true"] { background: var(--ink); color: var(--paper); border-color: var(--ink); }
.unpoke { width: 100%; margin-top: 0.28571rem; }
.chips { display: flex; flex-wrap: wrap; align-items: center; gap: 0.35714rem 0.28571rem; margin: 0.35714rem 0; }
.chips span { font-size: 0.893rem; color: var(--muted); margin-right: 0.21429rem; }
.panel .chips button { padding: 0.28571rem 0.5rem; border-radius: 7.07143rem; font-size: 0.857rem; }
.papers:not(:has(button)) { display: none; } /* no start of the paper flies here */
.panel .papers button { min-width: 2.21429rem; }
.story { display: contents; }
.story h2 { margin: 0; font-size: 0.929rem; font-weight: 650; }
.story h2 small { font-weight: 400; color: var(--muted); }
.story .chips { margin: 0.14286rem 0; }
.story .chips button { min-width: 2.85714rem; min-height: 2.85714rem; border-radius: 7.07143rem; }
.story .chips button[aria-pressed="true"] { background: var(--ink); color: var(--paper); border-color: var(--ink); }
.step { flex: 1 1 100%; display: flex; flex-wrap: wrap; align-items: baseline; gap: 0.14286rem 0.85714rem; font-size: 0.929rem; }
.step h3 { margin: 0; font-size: 1rem; font-weight: 650; }
.step p { flex: 1 1 22.85714rem; margin: 0; }
.drag { flex: 0 1 18.57143rem; }
.drag:empty { display: none; }
.step .next { padding: 0.42857rem 0.85714rem; }
.hint { margin: 0.14286rem 0 0; font-size: 0.857rem; color: var(--muted); }
.slider { display: grid; grid-template: auto auto / 1fr auto; margin: 0.21429rem 0; font-size: 0.929rem; }
.slider output { color: var(--muted); font-variant-numeric: tabular-nums; }
.slider input { grid-column: 1 / -1; width: 100%; height: 1.42857rem; margin: 0; appearance: none; cursor: pointer; touch-action: pan-y; }
.slider input { background: linear-gradient(to right, var(--barred) var(--least), transparent var(--least), transparent var(--most), var(--barred) var(--most)) center / calc(100% - 1rem) 0.85714rem no-repeat; }
.slider input::-webkit-slider-runnable-track { height: 0.21429rem; border-radius: 0.14286rem; background: linear-gradient(to right, var(--trail) var(--done), var(--line) var(--done)); }
.slider input::-webkit-slider-thumb { appearance: none; width: 1rem; height: 1rem; margin-top: -0.39286rem; border-radius: 50%; background: var(--trail); border: 0; }
.slider input::-moz-range-track { height: 0.21429rem; border-radius: 0.14286rem; background: var(--line); }
.slider input::-moz-range-progress { height: 0.21429rem; border-radius: 0.14286rem; background: var(--trail); }
.slider input::-moz-range-thumb { width: 1rem; height: 1rem; border: 0; border-radius: 50%; background: var(--trail); }
.complaint { margin: 0.14286rem 0 0.42857rem; font-size: 0.893rem; color: var(--failed); overflow-wrap: anywhere; }
.export { margin-top: 0.42857rem; }
.export textarea { width: 100%; resize: vertical; font: 0.821rem/1.45 ui-monospace, "SF Mono", Menlo, Consolas, monospace; color: inherit; background: var(--sky); border: 0.07143rem solid var(--line); border-radius: 0.57143rem; padding: 0.57143rem; white-space: pre; }
.handle { position: absolute; left: 0; top: 0; --across: max(3.14286rem, 3.1rem); width: var(--across); height: var(--across); margin: calc(var(--across) / -2) 0 0 calc(var(--across) / -2); padding: 0; border: 0.14286rem solid var(--rod); border-radius: 50%; background: none; cursor: grab; touch-action: none; opacity: 0.75; }
.coil { position: absolute; inset: 0; width: 100%; height: 100%; pointer-events: none; }
.coil.none { display: none; }
.coil polyline { fill: none; stroke: var(--ink); stroke-width: 1.5; stroke-linejoin: round; }
.newtons { position: absolute; left: 1rem; top: -0.7em; margin: 0; font-weight: 600; font-variant-numeric: tabular-nums; pointer-events: none; text-shadow: 0 0 0.21429rem var(--sky), 0 0 0.21429rem var(--sky), 0 0 0.21429rem var(--sky); }
.handle:hover, .handle:active { opacity: 1; border-color: var(--rod); }
.handle:active { cursor: grabbing; }
.map { grid-area: map; display: grid; grid-template: minmax(0, 1fr) / minmax(0, 1fr) minmax(14.28571rem, 21.42857rem); gap: 1.71429rem; padding: 0 1.71429rem 1.42857rem 0.85714rem; min-height: 0; }
.disc { min-height: 0; display: grid; place-items: center; overflow: hidden; }
.disc canvas { display: block; cursor: crosshair; }
.told { align-self: center; }
.share { margin: 0 0 0.57143rem; font-size: 1.214rem; font-weight: 650; font-variant-numeric: tabular-nums; }
.told .hint { font-size: 0.929rem; }
.scale { display: grid; grid-template: auto auto / auto 1fr auto; gap: 0.57143rem; align-items: center; margin: 1.28571rem 0; font-size: 0.929rem; color: var(--muted); }
.scale i { height: 0.71429rem; border-radius: 0.35714rem; background: linear-gradient(to right, #00224e, #3b496c, #7d7c78, #bcae6c, #fee838); }
.scale b { width: 0.85714rem; height: 0.85714rem; border-radius: 50%; background: var(--failed); }
.scale b + span { grid-column: 2 / -1; }
.here { min-height: 1.5em; margin: 0; font-size: 0.929rem; font-variant-numeric: tabular-nums; }
@media (min-width: 761px) and (max-width: 1080px) and (min-height: 760px) {
  main.lab { grid-template: auto auto minmax(0, 1.25fr) auto minmax(0, 1fr) / minmax(0, 1fr); grid-template-areas: "head" "bar" "scene" "foot" "plots"; }
  main.lab.tuned { grid-template-columns: 19.14286rem minmax(0, 1fr); grid-template-areas: "head head" "bar bar" "panel scene" "panel foot" "plots plots"; }
  main.lab[data-tab="map"] { grid-template-areas: "head" "bar" "map" "map" "map"; }
  main.lab.tuned[data-tab="map"] { grid-template-areas: "head head" "bar bar" "panel map" "panel map" "panel map"; }
  .lab .scene { margin: 0 0.85714rem; }
  .tuned .scene { margin: 0 0.85714rem 0 0; }
  .lab .plots { display: grid; grid-template-columns: repeat(2, minmax(0, 1fr)); grid-auto-rows: minmax(8.85714rem, 1fr); padding: 0.57143rem 0.85714rem; border-top: 0.07143rem solid var(--line); }
  .lab .plots:has(> :nth-child(5)) { grid-template-columns: repeat(3, minmax(0, 1fr)); }
  .map { grid-template: minmax(0, 1fr) auto / minmax(0, 1fr); padding: 0 1.42857rem 1.42857rem 0.57143rem; }
  .story { flex: 1 1 100%; display: flex; flex-wrap: wrap; align-items: center; gap: 0.42857rem 1.14286rem; } /* its title stays beside its numbers */
  .panel .papers span { flex: 1 0 100%; }
  .tuned .choices { gap: 0.28571rem; }
  .tuned .choice :is(button, select) { padding: 0.42857rem; }
}
@media (min-width: 761px) and (max-height: 520px) { /* a telephone on its side: the page scrolls, so that the picture has room */
  main.lab { height: auto; min-height: 100dvh; overflow: visible; grid-template-rows: auto auto max(17.85714rem, 100dvh - 9.28571rem) auto; }
  .lab .picture { touch-action: pan-y; }
  .lab > :is(.panel, .plots) { height: 0; min-height: 100%; }
  .lab .plot { min-height: 10.71429rem; }
  .lab .key { font-size: 0.786rem; }
  .story { flex: 1 1 100%; display: flex; flex-wrap: wrap; align-items: center; gap: 0.42857rem 1.14286rem; }
}
@media (max-width: 760px) {
  main.lab, main.lab.tuned { grid-template: auto 42vh auto auto auto auto / minmax(0, 1fr); grid-template-areas: "head" "scene" "bar" "foot" "panel" "plots"; }
  .lab .scene { position: sticky; top: 0; z-index: 2; border: solid var(--paper); border-width: 0 0 0.42857rem; border-radius: 0.85714rem 0.85714rem 1rem 1rem; }
  .lab footer { position: static; padding-top: 1rem; }
  main.lab[data-tab="map"], main.lab.tuned[data-tab="map"] { grid-template: auto auto auto auto / minmax(0, 1fr); grid-template-areas: "head" "bar" "map" "panel"; }
  .bar { padding: 0.28571rem 0.85714rem 0; }
  .five > * { flex: 1 1 auto; min-height: 3.14286rem; }
  .story:has([aria-pressed="true"]) > * { order: -1; } /* what is told comes before what can be done */
  .story .chips { flex-wrap: nowrap; gap: 0; justify-content: space-between; width: 100%; }
  .story .chips button { flex: 0 1 3.14286rem; min-width: 0 !important; padding: 0; } /* eight beside each other on the narrowest telephone */
  .step h3 { flex: 1 1 100%; }
  .lab header { gap: 0.57143rem 1.14286rem; }
  .lab h1 { flex: 1 1 100%; }
  .verdict { flex: 1 1 100%; }
  .panel { padding: 0 1.14286rem 1.71429rem; overflow: visible; }
  .panel section:first-child { border-top: 0.07143rem solid var(--line); padding-top: 0.71429rem; }
  .slider { font-size: 1rem; }
  .slider input { height: 2.28571rem; }
  .slider input::-webkit-slider-thumb { width: 1.57143rem; height: 1.57143rem; margin-top: -0.67857rem; }
  .slider input::-moz-range-thumb { width: 1.57143rem; height: 1.57143rem; }
  .row { font-size: 1rem; }
  .panel button, .panel .save { padding: 0.71429rem; font-size: 1rem; }
  .panel .chips button { padding: 0.57143rem 0.92857rem; font-size: 1rem; }
  .row select { padding: 0.57143rem; font-size: 1rem; width: min(16.42857rem, 100% - 5.57143rem); }
  .map { grid-template: minmax(0, 84vw) auto / minmax(0, 1fr); gap: 0.57143rem; padding: 0 1.14286rem 0.85714rem; }
}
.sheet svg { display: block; width: min(30rem, 100vw - 5.71429rem, 100dvh - 15.71429rem); margin: 0 auto; background: #fff; fill: #000; }
.sheet p { max-width: 30rem; margin: 0.71429rem auto 0; }
.game { grid-area: game; padding: 0 4vw 2vh; text-align: center; pointer-events: none; }
.game p { margin: 0.2em 0; }
.game .headline { font-size: clamp(1.9rem, 5.5vmin, 5.5rem); font-weight: 700; line-height: 1.15; font-variant-numeric: tabular-nums; }
.game .rules { font-size: clamp(1rem, 2.3vmin, 2.2rem); color: var(--muted); }
.game .best { font-size: clamp(1.1rem, 2.8vmin, 2.6rem); font-weight: 600; min-height: 1.45em; font-variant-numeric: tabular-nums; }
.leave { min-height: 3.14286rem; padding: 0.57143rem 1.28571rem; pointer-events: auto; }
main.lab.kiosk { height: 100dvh; overflow: hidden; background: var(--paper); grid-template: auto minmax(0, 1fr) auto / minmax(0, 1fr); grid-template-areas: "head" "scene" "game"; }
.kiosk > :is(.bar, .panel, .plots, footer) { visibility: hidden; position: absolute; width: 0; height: 0; overflow: hidden; }
.kiosk .scene { position: relative; margin: 0 0.85714rem 0.85714rem; }
.kiosk header > :not(h1), .kiosk .low, .kiosk .notice { display: none; }
.kiosk h1 { font-size: clamp(1.214rem, 3vmin, 2.6rem); }
.kiosk .motion b { font-size: 1.2em; }
.kiosk :is(.motion, .recovered, .near) { font-size: clamp(1rem, 2.3vmin, 2.2rem); }
.kiosk .handle { --across: max(6.28571rem, 9vmin); border-width: 0.28571rem; }
.kiosk .invite { display: none; }
.kiosk:not([data-game="idle"]):not([data-game="ready"]):not([data-game="held"]) .handle { visibility: hidden; }
main.lab.figure { height: 100dvh; min-height: 0; overflow: hidden; grid-template: minmax(0, 1fr) auto auto / minmax(0, 3fr) minmax(0, 2fr); grid-template-areas: "scene plots" "head bar" "foot foot"; }
.figure :is(h1, header .choice, .five, .story h2, .story .chips, .step > :not(.drag), .choices, .low) { display: none; }
.figure .scene { position: relative; margin: 0; border: 0; border-radius: 0.71429rem; }
.figure .picture { touch-action: pan-y; }
.figure .plots { overflow: hidden; }
.figure .plot { flex: 1; }
.figure .area { flex: 1; height: auto; }
.figure .drag { flex: 1; }
.figure header { padding: 0.57143rem 0.85714rem 0; }
.figure .bar { display: block; padding: 0.57143rem 0.85714rem 0; }
.figure footer { position: static; padding: 0.28571rem 0.85714rem 0.42857rem; }
@media (max-width: 600px) {
  main.lab.figure { grid-template: auto minmax(0, 1fr) auto auto 9.28571rem / minmax(0, 1fr); grid-template-areas: "head" "scene" "bar" "foot" "plots"; }
  .figure header { padding: 0 0.28571rem 0.42857rem; }
  .figure .recovered { display: none; } /* it would lie on a rod that stands */
}
`;var Wc=[.1,.25,.5,1,2],gg=2,Po=class{constructor(t,e,i){Object.assign(this,{start:t,end:e,changed:i,time:t,speed:1,playing:!1,drive:null,loop:!1,rested:0})}span(t,e){Object.assign(this,{start:t,end:e}),this.seek(this.time)}follow(t){this.drive=t,this.playing=!!t,this.changed()}play(){this.drive?this.time=this.end:this.time>=this.end&&(this.time=this.start),this.playing=!!this.drive||this.end>this.start,this.changed()}pause(){this.playing=!1,this.changed()}toggle(){this.playing?this.pause():this.play()}seek(t){Number.isFinite(t)&&(this.time=Te(t,this.start,this.end),this.changed())}setSpeed(t){t>0&&(this.speed=t,this.changed())}shift(t){let e=Wc.filter(i=>(i-this.speed)*t>1e-9);e.length&&this.setSpeed(t>0?e[0]:e[e.length-1])}tick(t){if(this.playing){if(this.drive){this.drive(t,this.speed);return}this.time=Math.min(this.time+t*this.speed,this.end),this.time<this.end?this.rested=0:this.loop?(this.rested+=t)>gg&&(this.time=this.start):this.pause()}}};var si=()=>parseFloat(getComputedStyle(document.documentElement).fontSize)/14;function rs(s,t,e){let{canvas:i}=s,n=si()*(window.devicePixelRatio||1),r=Math.round(t*n),o=Math.round(e*n);(i.width!==r||i.height!==o)&&Object.assign(i,{width:r,height:o}),s.setTransform(1,0,0,1,0,0),s.clearRect(0,0,r,o),s.setTransform(n,0,0,n,0,0)}var Lo=s=>`${s}px system-ui, sans-serif`;function Pi(s,t){s.moved!==t&&(s.moved=t,s.style.transform=t)}function Se(s,t){let{firstChild:e}=s;e?e.data!==t&&(e.data=t):s.textContent=t}var xg={play:"M8 5.5v13l11-6.5z",pause:"M7 5h3.6v14H7zM13.4 5H17v14h-3.6z",again:"M12 5V1.8L7 6l5 4.2V7a5 5 0 1 1-5 5H5a7 7 0 1 0 7-7z"},No=class{constructor(t,e){this.clock=e,t.innerHTML=`<button class="play" type="button"><svg viewBox="0 0 24 24" aria-hidden="true"><path/></svg></button>
      <output class="time"></output>
      <span class="track"><input class="line" type="range" step="any" aria-label="Time"></span>
      <label class="speed"><span>speed</span> <select aria-label="Speed"></select></label>`;let i=n=>t.querySelector(n);Object.assign(this,{button:i(".play"),icon:i("path"),time:i(".time"),line:i(".line"),speed:i("select")}),this.button.addEventListener("click",()=>e.toggle()),this.line.addEventListener("input",()=>e.seek(Number(this.line.value))),this.speed.addEventListener("change",()=>e.setSpeed(Number(this.speed.value)))}mark(t){let{clock:e}=this,i=this.line.parentElement;for(let n of i.querySelectorAll(".touch"))n.remove();i.append(...t.filter(n=>n.verdict.part).map(({end:n,verdict:r})=>{let o=document.createElement("i"),a=`${r.reason} at ${n.toFixed(2)} s`;return Object.assign(o,{className:"touch",role:"img",ariaLabel:a,title:a}),o.style.setProperty("--at",(n-e.start)/(e.end-e.start||1)),o}))}show(t=!0){let{clock:e}=this,i=e.playing?"pause":!e.drive&&e.time>=e.end&&e.end>e.start?"again":"play";this.shown!==i&&(this.shown=i,this.icon.setAttribute("d",xg[i]),this.button.setAttribute("aria-label",{play:"Play",pause:"Pause",again:"Play again"}[i]),this.button.title=`${this.button.getAttribute("aria-label")} (space)`);let n=e.end>=1?2:4;t&&Se(this.time,`${e.time.toFixed(n)} / ${e.end.toFixed(n)} s`),this.#t();let r=(e.time-e.start)/(e.end-e.start||1);!t&&r===this.share||(this.share=r,Object.assign(this.line,{min:e.start,max:e.end,value:e.time}),this.line.style.setProperty("--done",`${100*r}%`))}#t(){let{speed:t,clock:e}=this;if(this.offered===e.speed)return;this.offered=e.speed;let i=[...new Set([...Wc,e.speed])].sort((n,r)=>n-r);t.replaceChildren(...i.map(n=>new Option(`${n}\xD7`,n,!1,n===e.speed)))}},Li=class{constructor(t,e,i,n){this.root=document.createElement("div"),Object.assign(this.root,{className:"choice",role:"group",ariaLabel:e}),this.buttons=i.map(([r,o,a])=>{let l=document.createElement("button");return Object.assign(l,{type:"button",textContent:o,title:a}),l.dataset.name=r,l.addEventListener("click",()=>n(r)),l}),this.root.append(...this.buttons),t.append(this.root)}show(t){for(let e of this.buttons)e.setAttribute("aria-pressed",String(e.dataset.name===t))}},Xc=!1;document.addEventListener("keydown",({key:s})=>Xc||=s==="Tab",!0);document.addEventListener("pointerdown",()=>Xc=!1,!0);function Do(s){document.addEventListener("keydown",t=>{let e=s[t.key.length===1?t.key.toLowerCase():t.key];if(!(!e||t.ctrlKey||t.metaKey||t.altKey)&&!t.target.closest("select, textarea")&&!(t.target.closest("[data-keys]")&&t.key.length>1)){if(t.key===" "&&t.target.closest("button")){if(Xc)return;t.target.blur()}t.preventDefault(),e(t.shiftKey)}})}var qc=["disc","square","triangle","diamond"];var yd={square:[[-.85,-.85],[.85,-.85],[.85,.85],[-.85,.85]],triangle:[[0,-1.15],[1.05,.75],[-1.05,.75]],diamond:[[0,-1.25],[1.05,0],[0,1.25],[-1.05,0]]};function bd(s,t,e,i,n,r){s.beginPath(),t==="disc"?s.arc(e,i,3.4,0,2*Math.PI):yd[t].forEach(([o,a])=>s.lineTo(e+3.4*o,i+3.4*a)),s.closePath(),Object.assign(s,{fillStyle:n,strokeStyle:r,lineWidth:1.2}),s.fill(),s.stroke()}function Md(s){return`<svg class="mark" viewBox="-9 -5 18 10" aria-hidden="true"><path d="M-9 0H9"/>${s==="disc"?`<circle r="${3.4}"/>`:`<polygon points="${yd[s].map(([e,i])=>`${3.4*e},${3.4*i}`).join(" ")}"/>`}</svg>`}var ir=[[],[6,3],[2,3],[8,3,2,3]],Sd=[3.4,2.5,1.6,.8],wd=["rotor1","rotor2","rotor3","rotor4"],_g=.05,vg=.001;function $c(s,t=-1/0){let[e]=s,i=t>-1/0,n=Math.max(t,Math.min(...s.map(m=>m.start))),r=i?e.end:Math.max(...s.map(m=>m.end)),o=(m,g,b,E,M=s)=>M.map((T,A)=>{let x=s.indexOf(T),S={dash:ir[x],width:x?1.3:1.8,opacity:x?.75:1},U=i?Qe(T.t,n):0;return{label:A?"":g,role:b,mark:A?"":E,...S,t:T.t.subarray(U),values:T.series(m,U)}}),a=s.filter(m=>m.verdict.part).map(m=>m.end),l={start:n,end:r,touches:a},c=e.e3==="up"?["inverted","hanging"]:["hanging","inverted"],h=(e.e3==="up"?1:-1)*e.vehicle.weight,u=e.vehicle.weight/e.rotors,d=s.filter(m=>m.columns.clearance),f=s.filter(m=>m.columns.V),p=Array.from({length:e.rotors},(m,g)=>g),_=e.phases.filter(({to:m})=>m>n);return[{...l,phases:_,title:"Rod <i>y</i>\u2083 and thrust axis <i>z</i>\u2083",plain:"Rod y\u2083 and thrust axis z\u2083",unit:"",range:[-1.12,1.12],names:[[1,`y\u2083 = 1: ${c[0]}`],[-1,`y\u2083 = \u22121: ${c[1]}`]],lines:[...o("y3","<i>y</i>\u2083","rod","disc"),...o("z3","<i>z</i>\u2083","trail","square")]},...f.length?[{...l,title:"Lyapunov function <i>V</i>",plain:"Lyapunov function V",unit:"",log:!0,least:vg,lines:o("V","<i>V</i>","trail","square",f)}]:[],{...l,title:"Thrust <i>f</i>",plain:"Thrust",unit:"N",levels:[[h,"hover"]],scale:Math.abs(h),lines:o("thrust","<i>f</i>","thrust","disc")},{...l,wide:!0,title:"Rotor forces",plain:"Rotor forces",unit:"N",levels:[[u,"hover"]],scale:u,limits:e.vehicle.rotor_limits,lines:p.flatMap(m=>o(`rotor ${m+1}`,String(m+1),wd[m%wd.length],qc[m%qc.length]).filter((g,b)=>b===0||s[b].rotors>m).map((g,b)=>b?{...g,opacity:.35}:{...g,width:Sd[m%Sd.length]}))},{...l,title:"Distance from the reference",plain:"Distance from the reference",unit:"m",least:_g,lines:o("distance","\u2016<i>x</i> \u2212 <i>x</i><sub>ref</sub>\u2016","ink","disc")},...d.length?[{...l,title:"Clearance of the rod",plain:"Clearance of the rod",unit:"m",levels:[[0,"touches"]],lines:o("clearance","distance","rod","disc",d)}]:[]]}function Uo(s,t){let e=/^([a-zA-Z])_(\w{1,3})$/.exec(t);if(!e){s.append(t.replaceAll("_"," "));return}let i=document.createElement("i"),n=document.createElement("sub");i.textContent=e[1],n.textContent=e[2],s.append(i,n)}var yg={"1/s":"s\u207B\xB9","1/s\xB2":"s\u207B\xB2"},Yc=s=>s&&` ${yg[s]??s}`,bg=Object.fromEntries([..."\u22120123456789"].map((s,t)=>[s,"\u207B\u2070\xB9\xB2\xB3\u2074\u2075\u2076\u2077\u2078\u2079"[t]])),Oo=s=>s.replace("-","\u2212"),vi=s=>Oo(String(+s.toPrecision(4))),Fo=s=>`10${[...Oo(String(s))].map(t=>bg[t]).join("")}`;function Ed(s){if(s<-300)return"0";let[t,e]=(10**s).toExponential(1).split("e");return`${t}\xB7${Fo(Number(e))}`}function Ad(s){let t=Math.abs(s);return t>=1e4?ko(s):Oo(s.toFixed(t>=1e3?0:t>=100?1:2))}function ko(s){let t=Math.abs(s),[e,i]=t>=1e9?[1e9,"G"]:t>=1e6?[1e6,"M"]:t>=1e3?[1e3,"k"]:[1,""];return`${Oo(String(+(s/e).toPrecision(2)))}${i&&` ${i}`}`}function Td(s,t){let e=document.createElement("style");e.textContent=s,document.head.append(e);let i=document.createElement("main");i.innerHTML=`
    <header><h1></h1><div class="legend"></div></header>
    <section class="scene" aria-label="Flight"><canvas class="picture" role="img"></canvas><p class="note" role="status"></p><p class="invite" hidden></p><div class="low"></div></section>
    <section class="plots" aria-label="Plots" tabindex="0"></section>
    <footer><div class="player"></div><div class="choices"></div></footer>`,document.body.append(i);let n=r=>i.querySelector(r);return n("h1").textContent=t,{legend:n(".legend"),scene:n(".scene"),canvas:n(".picture"),note:n(".note"),invite:n(".invite"),low:n(".low"),plots:n(".plots"),player:n(".player"),choices:n(".choices")}}function Rd(s,t){s.replaceChildren(),t.forEach((e,i)=>{let n=document.createElement("p");n.innerHTML=`<svg width="30" height="10" aria-hidden="true"><line x1="1" x2="29" y1="5" y2="5"/></svg>
      <strong></strong> <span class="detail"></span> <em class="verdict"></em>`;let r=o=>n.querySelector(o);r("line").setAttribute("stroke-dasharray",ir[i].join(" ")),n.className=t.length===1?"only":i?"ghost":"",r("strong").textContent=e.title,e.gains.forEach(([o,a],l)=>{l&&r(".detail").append(", "),Uo(r(".detail"),o),r(".detail").append(` = ${a}`)}),Bn(r("em"),e.verdict),s.append(n)})}function Bn(s,{words:t,state:e,reason:i}){s.textContent=t,i&&!t.includes(i)&&(s.textContent+=`: ${i}`),s.className=`verdict ${e}`}var Id=60,Mg=.25,Cd=3,nr=5,Sg=4e3,wg=200,Eg=`Grab the ball and fling it. Score: the seconds until rod and drone are back in place. Make it take ${nr} s, or crash it, and you win.`,Ag=`<p class="headline" role="status"></p><p class="rules">${Eg}</p><p class="best"></p>`;function Zc({search:s}=location){let t=new URLSearchParams(s).get("kiosk");return t===null?null:Number(t)>0?Number(t):Id}var sr=class{constructor(t,{quiet:e=Id,leave:i=null}={}){Object.assign(this,{lab:t,quiet:e,best:null,game:"idle",touched:performance.now(),score:null}),this.root=document.createElement("section"),Object.assign(this.root,{className:"game",innerHTML:Ag,ariaLabel:"Beat the controller"});let n=r=>this.root.querySelector(r);if(Object.assign(this,{headline:n(".headline"),high:n(".best")}),i){let r=Object.assign(document.createElement("button"),{type:"button",className:"leave",textContent:"Leave kiosk"});r.addEventListener("click",i),this.root.append(r)}t.main.append(this.root),t.main.classList.add("kiosk"),this.touch=({target:r})=>!r.closest?.(".leave")&&this.#i(),document.addEventListener("pointerdown",this.touch,!0),this.timer=setInterval(()=>this.#a(),wg),this.#t("idle"),t.flew&&this.#e()}end(){let{lab:t}=this;document.removeEventListener("pointerdown",this.touch,!0),clearInterval(this.timer),this.game=null,this.root.remove(),t.main.classList.remove("kiosk"),delete t.main.dataset.game}#t(t){this.game=this.lab.main.dataset.game=t,this.#l()}#e(){this.score=null,this.#t("idle"),this.lab.repeat()}#i(){let{lab:t}=this,{viewer:e}=t;this.touched=performance.now(),!(this.game!=="idle"||!t.flew)&&(e.take(),t.running.on||(e.clock.seek((t.verdict?.settling??e.clock.start)+.1),t.running.go(!0)),t.running.on&&this.#t("rises"))}pull(t){let{running:e}=this.lab;t&&this.game==="ready"&&(this.held=e.flight.end,this.#t("held")),this.game==="held"&&(e.pull(t),t||this.#n())}#n(){this.lab.running.pull(null),this.released=this.lab.running.flight.end,this.#t("watch")}frame(){let{running:t}=this.lab,{flight:e}=t;if(!t.on||!e)return;let{end:i}=e;t.over?this.game!=="won"&&this.#o(this.game==="watch"||this.game==="held"):this.game==="rises"&&e.state(i)==="done"?this.#t("ready"):this.game==="held"&&i-this.held>Cd?this.#n():this.game==="watch"&&this.#s(e),(this.game==="held"||this.game==="watch")&&this.#l()}#s(t){let{all:e,open:i}=t.recoveries(),{end:n}=t,r=e[e.length-1];i?(this.score=Math.max((i.back??n)-this.released,0),n-this.released>nr&&i.back===null&&this.#o(!0)):n-this.released>t.hold&&(this.score=Math.max((r?.end??0)-this.released,0),this.#r(this.score),this.#t("ready"))}#r(t){this.best=Math.max(this.best??0,Math.min(t,nr))}#o(t){t&&this.#r(nr),this.flung=t,this.#t("won"),this.lab.running.pull(null),setTimeout(()=>{this.game==="won"&&(this.score=null,this.lab.running.restart(),this.#t("rises"))},Sg)}#a(){let{lab:{running:t,viewer:{clock:e}},game:i}=this,n=performance.now();e.playing&&["held","watch"].includes(i)||i==="idle"&&!t.on?this.touched=n:n-this.touched>1e3*(i==="idle"?Mg*this.quiet:this.quiet)&&this.#e()}#l(){let{game:t,score:e,best:i,lab:{running:n}}=this,r=a=>`${a.toFixed(1)} s`,o={idle:"Beat the controller",rises:"It swings up: wait until it is balanced",ready:e===null?"Grab the ball and fling it":`Back in ${r(e)}. Fling it again`,held:`Let go: ${r(Math.max(Cd-((n.flight?.end??0)-(this.held??0)),0))}`,watch:r(e??0),won:this.flung?"You win":"It fell"};Se(this.headline,o[t]),Se(this.high,i===null?"":`Best so far: ${i>=nr?"a win":r(i)}`)}};var Pd=20,Bo=class extends Fn{constructor(t){super(t),this.room={},this.count=0,this.counted=new ns(this.hold),this.take(t.columns,t)}take(t,{verdict:e,completed:i}){let n=t.t.length,r=this.#t(t.t[n-1]);for(let[o,a]of Object.entries(t)){let l=a.length/n,c=(this.count-r+n)*l,h=this.room[o];(!h||h.length<c)&&(h=new Float64Array(Math.max(2*c,1024*l)));let u=(this.room[o]??h).subarray(r*l,this.count*l);(h!==this.room[o]||r)&&h.set(u),h.set(a,(this.count-r)*l),this.room[o]=h,this.columns[o]=h.subarray(0,c)}this.counted.next=this.count-r,this.count+=n-r,this.t=this.columns.t,this.counted.read(this,1/0),this.turned=Nc(this,this.turned.slice(r,r+this.count-n)),Object.assign(this,{verdict:e,completed:i,found:null})}phase(t){return Pc(this,this.at(t))}recoveries(){return this.counted}#t(t){return this.count===0||t-this.t[0]<2*Pd?0:this.t.findIndex(e=>e>=t-Pd)}};var Tg=8,Rg=250,Cg=.1,Ig={stiffness:60,damping:6,most:1.5},zo=class{constructor(t){Object.assign(this,{lab:t,on:!1,pokes:[],pulling:null,due:0,asked:!1,drawn:0})}get able(){return!!this.lab.link.facts}follows(t){let{link:e}=this.lab;return Be(t)===this.kind&&!e.rebuilds(t)}toggle(){this.go(!this.on)}go(t){if(t===this.on||t&&!this.able)return;this.on=t;let{viewer:e,main:i}=this.lab;i.classList.toggle("running",t),this.lab.panel.live(t),t&&this.lab.show("flight"),t?this.#t(Math.round(e.clock.time/this.lab.link.facts.period)):(e.clock.follow(null),this.lab.changed())}restart(){this.on&&this.#t(0)}#t(t){let{lab:e}=this,{clock:i}=e.viewer;e.adopt(e.link.whole(e.setting.value).start),Object.assign(this,{kind:Be(e.setting.value),pokes:[],poked:0,pulling:null,due:0,asked:!0,flight:null,stood:!1}),e.panel.fell(""),this.change(),i.follow((n,r)=>this.#e(n*r)),e.link.begin(e.setting.value,Math.max(t,1),n=>this.#i(n))}change(){let{link:t,setting:e,panel:i}=this.lab;this.turned=zc(e.value,t.facts,!0),i.sliders(t.sliders(e.value))}poke(t,e){this.on&&this.pokes.push(Gc(t,e,this.lab.link.facts))}pull(t){let{facts:e}=this.lab.link,{stiffness:i,damping:n,most:r}=Ig,o=e.masses.bob;this.pulling=this.on&&t?{place:t,stiffness:i*o,damping:n*o,most:r*this.lab.record.vehicle.weight}:null}#e(t){this.due=Math.min(this.due+t,Cg);let{period:e}=this.lab.link.facts,i=Math.floor(this.due/e+1e-9);this.asked||i<1||this.over||(this.due-=i*e,this.asked=!0,this.lab.link.advance({ticks:i,...this.turned,pokes:this.pokes,pull:this.pulling}),this.poked+=this.pokes.length,this.pokes=[])}#i({columns:t,outcome:e,tick:i}){if(!this.on)return;let{lab:n}=this,{viewer:r}=n,o=tr(e,n.link.facts);if(Object.assign(this,{asked:!1,tick:i,over:e.status!==0}),!t.t.length)return;let a={verdict:this.over?o:{words:"live",state:"recovering",settling:null},completed:!this.over};this.flight?this.flight.take(t,a):(this.flight=new Bo({...n.record,columns:t,...a}),r.load([this.flight,...n.ghosts]));let l=performance.now(),c=l-this.drawn>Rg||this.over;c&&(this.drawn=l,this.#n(o)),r.grown(Tg,c),this.over&&r.clock.pause()}#n(t){let{y:e}=this.flight.at(this.flight.end),i=this.flight.e3==="up"?1:-1,n=On(i*e[2]),r=this.flight.state(this.flight.end),o=this.over?t.words:r==="done"?"live: upright":`live: recovering, rod ${n.toFixed(0)}\xB0 from upright`;this.#s(r,i*e[2]<0),this.lab.verdict={words:o,good:r==="done",state:r},Bn(this.lab.words,{words:o,state:r,reason:t.reason})}#s(t,e){this.stood||=t==="done",!(!this.stood||!(e||this.over))&&(this.stood=!1,this.lab.panel.fell(`Fell after ${this.flight.end.toFixed(1)} s`))}told(){return{on:this.on,tick:this.tick,over:!!this.over,pulled:this.pulling!==null,poked:this.poked,samples:this.flight?.t.length??0}}};var os=104,Pg=30,Go=class{constructor(t){this.canvas=document.createElement("canvas"),this.canvas.className="compass",this.canvas.setAttribute("role","img"),this.canvas.setAttribute("aria-label","Direction of gravity and axes of the frame"),t.append(this.canvas);let e=si(),i=e*(window.devicePixelRatio||1);this.canvas.width=this.canvas.height=os*i,this.canvas.style.width=this.canvas.style.height=`${os*e}px`,this.context=this.canvas.getContext("2d"),this.context.scale(i,i)}draw({right:t,up:e,back:i},n,r){let{context:o}=this,a=n==="up"?1:-1,l=JSON.stringify([t,e,n,r.ink]);if(this.drawn===l)return;this.drawn=l;let c=f=>[t,e,i].map(p=>p[0]*f[0]+p[1]*f[1]+p[2]*f[2]);o.clearRect(0,0,os,os);let h=[["e\u2081",[1,0,0]],["e\u2082",[0,a,0]],["e\u2083",[0,0,a]]];for(let[f,p]of n==="up"?h:h.slice(0,2))this.#t(c(p),f,r.muted,1.2,.72);let u=n==="up"?"g":"g, e\u2083",d=c([0,0,-1]);Math.hypot(d[0],d[1])>.2?this.#t(d,u,r.ink,2.2,1.25):this.#e(d[2]<0,u,r.ink)}#t([t,e],i,n,r,o){let{context:a}=this,l=os/2,c=Math.hypot(t,e)*Pg*o;if(c<8)return;let h=Math.atan2(-e,t),u=Math.min(3.4*r+2,c);a.save(),a.translate(l,l),a.rotate(h),Object.assign(a,{strokeStyle:n,fillStyle:n,lineWidth:r}),a.beginPath(),a.moveTo(0,0),a.lineTo(c-u,0),a.stroke(),a.beginPath(),a.moveTo(c,0),a.lineTo(c-u,.45*u),a.lineTo(c-u,-.45*u),a.fill(),a.restore(),this.#i(i,l+Math.cos(h)*(c+8),l+Math.sin(h)*(c+8),n,i[0]==="g")}#e(t,e,i){let{context:n}=this,r=os/2,o=9,a=o*Math.SQRT1_2;if(Object.assign(n,{strokeStyle:i,fillStyle:i,lineWidth:1.8}),n.beginPath(),n.arc(r,r,o,0,2*Math.PI),t)for(let l of[-1,1])n.moveTo(r-a,r-l*a),n.lineTo(r+a,r+l*a);n.stroke(),t||(n.beginPath(),n.arc(r,r,2.5,0,2*Math.PI),n.fill()),this.#i(e,r-o-9,r+o+3,i,!0)}#i(t,e,i,n,r){let{context:o}=this;o.font=`${r?"italic 600 15px":"italic 11px"} "Cambria Math", Cambria, Georgia, serif`,Object.assign(o,{fillStyle:n,textAlign:"center",textBaseline:"middle"}),o.fillText(t,e,i)}};var Lg=[["failed","no start: the rod would touch"],["rod","rod and bob"],["front","front rotor"],["thrust","thrust of each rotor, total in outline"],["trail","path of the bob"],["ink","path of the vehicle"],["reference","reference"]],Ld=14,Ng=1,Vo=class{constructor(t,e){Object.assign(this,{parent:t,views:[],marks:[],heights:document.createElement("div")}),t.querySelector(".picture").after(this.heights);let i=document.createElement("p");i.className="key",i.innerHTML=Lg.map(([n,r])=>`<span><i style="background:var(--${n})"></i>${r}</span>`).join("")+'<span class="grid"></span>',e.append(i),this.grid=i.querySelector(".grid"),this.barred=i.firstChild,this.near=Object.assign(document.createElement("p"),{className:"near",hidden:!0}),this.room=this.near.appendChild(document.createElement("span")),t.append(this.near),this.low=e,this.sizes=new ResizeObserver(()=>this.#e()),this.sizes.observe(e)}load(t){this.several=t.length>1;for(let e of this.views)this.sizes.unobserve(e.said),e.root.remove();this.views=t.map(e=>{let i=document.createElement("div");i.className="view",i.innerHTML='<div class="said"><p class="motion"><span class="name"></span><b></b> <span class="moving"></span></p><p class="recovered"></p><p class="ended"></p></div>',this.parent.append(i);let n=i.querySelector(".said");return this.sizes.observe(n),{flight:e,root:i,said:n,phase:i.querySelector(".motion b"),motion:i.querySelector(".moving"),name:i.querySelector(".name"),recovered:i.querySelector(".recovered"),ended:i.querySelector(".ended"),compass:new Go(i)}})}show(t,e,i,n=!0){this.views.forEach((o,a)=>{let l=t.views[a],{flight:c}=o;if(o.root.hidden===!!l&&(o.root.hidden=!l),!l)return;Nd(o,l),o.compass.draw(l,c.e3,i);let{x:h,x_dot:u}=t.flyers[a].pose,d=h[2]-t.flyers[a].base,f=d.toFixed(1).replace("-0.0","0.0").replace("-","\u2212");Se(o.name,this.several?`${c.title}: `:"");let p=c.state(e),_=p==="failed"&&!c.completed;Se(o.phase,_?c.verdict.words.split(" ")[0]:c.phase(e)),o.phase.className!==p&&(o.phase.className=p),n&&Se(o.motion,`${d<-Ng?`fell ${(-d).toFixed(1)} m`:`height ${f} m`}, speed ${$e(u).toFixed(1)} m/s`),n&&Se(o.recovered,c.e3==="up"?ud(c.recoveries(e),Math.min(e,c.end)):""),Se(o.ended,e>=c.end&&!c.completed?c.verdict.words:"")}),this.barred.hidden===t.barred.visible&&(this.barred.hidden=!t.barred.visible),this.#i(t.marks()),this.#t(t.near);let r=t.factor>1?`machine \xD7 ${t.factor}, `:"";Se(this.grid,`${r}grid ${+t.spacing.toPrecision(2)} m`)}#t(t){if(this.near.hidden===!!t&&(this.near.hidden=!t),!t)return;let{left:e,top:i,side:n,clearance:r}=t;Nd({root:this.near,box:this.framed},{left:e,top:i,width:n,height:n}),this.framed=[e,i,n,n].join(),Se(this.room,Jc(r))}#e(){let{left:t,top:e}=this.parent.getBoundingClientRect();this.taken=[...this.low.querySelectorAll(".globe, figcaption, .key"),...this.views.map(({said:i})=>i)].map(i=>i.getBoundingClientRect()).filter(({width:i})=>i).map(i=>({left:i.left-t,top:i.top-e,right:i.right-t,bottom:i.bottom-e})),this.pole&&this.#i(this.pole)}#i(t){for(this.pole=t,t=t.filter(({at:[e,i],before:n,size:r})=>!this.taken?.some(o=>e-n<o.right&&e-n+r>o.left&&i+Ld>o.top&&i-Ld<o.bottom));this.marks.length<t.length;){let e=document.createElement("span");e.className="height",this.heights.append(e),this.marks.push(e)}this.marks.forEach((e,i)=>{if(e.hidden!==i>=t.length&&(e.hidden=i>=t.length),e.hidden)return;let{height:n,at:[r,o],before:a}=t[i];Se(e,`${+n.toFixed(2)} m`.replace("-","\u2212")),Pi(e,`translate(${r.toFixed(1)}px, ${o.toFixed(1)}px)${a?" translateX(-100%) translateX(-1.2rem)":""}`)})}},Jc=s=>s>0?`${(1e3*s).toFixed(0)} mm gap`:"touches";function Nd(s,{left:t,top:e,width:i,height:n}){let r=[t,e,i,n].join();s.box!==r&&(s.box=r,Object.assign(s.root.style,{left:`${t}px`,top:`${e}px`,width:`${i}px`,height:`${n}px`}))}function Dd(s,{codec:t,width:e,height:i,duration:n}){let r=yi(440786851,[ri(17030,1),ri(17143,1),ri(17138,4),ri(17139,8),Ho(17026,"webm"),ri(17031,4),ri(17029,2)]),o=yi(357149030,[ri(2807729,1e6),Og(17545,n),Ho(19840,"flypend"),Ho(22337,"flypend")]),a=yi(224,[ri(176,e),ri(186,i)]),l=yi(174,[ri(215,1),ri(29637,1),ri(131,1),Ho(134,t),a]),c=yi(408125543,[o,yi(374648427,[l]),...Dg(s)]);return new Blob([r,c].flat(1/0),{type:"video/webm"})}function Dg(s){let t=s.flatMap((e,i)=>e.type==="key"?[i]:[]);return t.map((e,i)=>{let n=Ud(s[e]),r=s.slice(e,t[i+1]).map(o=>Ug(o,n));return yi(524531317,[ri(231,n),...r])})}function Ug(s,t){let e=new Uint8Array(4+s.byteLength),i=new DataView(e.buffer);return i.setUint8(0,129),i.setInt16(1,Ud(s)-t),i.setUint8(3,s.type==="key"?128:0),s.copyTo(e.subarray(4)),yi(163,[e])}var Ud=({timestamp:s})=>Math.round(s/1e3);function yi(s,t){let e=t.flat(1/0),i=new Uint8Array(8);return new DataView(i.buffer).setBigUint64(0,1n<<56n|BigInt(e.reduce((n,{length:r})=>n+r,0))),[Od(s),i,...e]}var ri=(s,t)=>yi(s,[Od(t)]),Ho=(s,t)=>yi(s,[new TextEncoder().encode(t)]);function Og(s,t){let e=new Uint8Array(8);return new DataView(e.buffer).setFloat64(0,t),yi(s,[e])}function Od(s){let t=s.toString(16);return Uint8Array.from(t.padStart(t.length+t.length%2,"0").match(/../g),e=>parseInt(e,16))}var qi=30,Fg=1.5,kg=60,Bg=.2,zg=4,Gg=720,Vg={V_VP9:"vp09.00.51.08",V_VP8:"vp8"},jc={"as seen":null,"720p":[1280,720],"1080p":[1920,1080],"4K":[3840,2160]},Kc=()=>typeof VideoEncoder<"u",Wo=class{constructor(t,e,i){Object.assign(this,{viewer:t,told:i,...Fd(t,e),given:!1}),this.canvas=Object.assign(document.createElement("canvas"),{width:this.width,height:this.height})}async shoot(t,e){let{viewer:i,width:n,height:r,canvas:o}=this,{speed:a}=i.clock,l=[],c=await this.#t(),h=new VideoEncoder({output:f=>l.push(f),error:f=>this.given=f});h.configure(c.settings);let u=Math.max(Math.ceil((e-t)/a*qi-1e-9),1),d=u+Math.round(Fg*qi);for(let f=0;f<=d&&!this.given;f++){f<=u&&this.#e(Math.min(t+f*a/qi,e),f===u);let p=new VideoFrame(o,{timestamp:1e6*f/qi,duration:1e6/qi});h.encode(p,{keyFrame:f%kg===0}),p.close(),this.told(f/d);do await new Promise(_=>setTimeout(_));while(h.encodeQueueSize>zg&&!this.given)}if(this.given||await h.flush(),h.state!=="closed"&&h.close(),this.given instanceof Error)throw this.given;return this.given?null:Dd(l,{codec:c.name,width:n,height:r,duration:1e3*(d+1)/qi})}stop(){this.given=!0}async#t(){let{width:t,height:e}=this,i={width:t,height:e,framerate:qi,bitrate:Bg*qi*t*e},n=Object.entries(Vg).map(([r,o])=>({name:r,settings:{...i,codec:o}}));for(let r of n)if((await VideoEncoder.isConfigSupported(r.settings)).supported)return r;throw new Error("this browser encodes no WebM")}#e(t,e){let{viewer:i,canvas:n}=this,{theme:{colours:r}}=i;i.clock.time=t,i.expose(this,1/qi);let{context:o,size:a}=kd(i,n);!e||i.clock.drive||i.flights.forEach(({title:l,verdict:c},h)=>{o.fillStyle=r[c.state],o.fillText(i.flights.length>1?`${l}: ${c.words}`:c.words,a,(4+1.4*h)*a)})}};function Fd({stage:s},t){let[e,i]=t??[s.width*s.ratio,s.height*s.ratio],n=r=>2*Math.round(r/2);return{width:n(e),height:n(i),scale:t?i/Gg:s.ratio}}function kd(s,t){let{clock:e,stage:i,parts:{canvas:n},theme:{colours:r}}=s,o=t.getContext("2d"),a=14*t.height/i.height;o.fillStyle=r.sky,o.fillRect(0,0,t.width,t.height),o.drawImage(n,0,0,t.width,t.height),Object.assign(o,{fillStyle:r.ink,textBaseline:"top",font:`600 ${a}px system-ui, sans-serif`}),o.fillText(s.title,a,a),o.font=`${a}px system-ui, sans-serif`;let[l]=s.flights;return i.near&&Hg(o,i.near,t.height/i.height,r),o.fillText(`${e.time.toFixed(2)} s, ${e.speed}\xD7 real time, ${l.phase(e.time)}`,a,2.4*a),{context:o,size:a}}function Hg(s,{left:t,top:e,side:i,clearance:n},r,o){Object.assign(s,{strokeStyle:o.line,lineWidth:1.5*r}),s.strokeRect(r*t,r*e,r*i,r*i),s.fillText(Jc(n),r*(t+10),r*(e+i-24))}function Bd(s,t,e){let i=Fd(s,t),n=Object.assign(document.createElement("canvas"),{width:i.width,height:i.height});s.expose(i,0),kd(s,n),n.toBlob(e,"image/png"),s.resume()}function rr(s,t){let e=document.createElement("a");e.href=URL.createObjectURL(s),e.download=t,e.click(),setTimeout(()=>URL.revokeObjectURL(e.href),1e3)}var zn=(s=>(s[s.Border=-1]="Border",s[s.Data=0]="Data",s[s.Function=1]="Function",s[s.Position=2]="Position",s[s.Timing=3]="Timing",s[s.Alignment=4]="Alignment",s))(zn||{}),Wg=[0,1],Gd=[1,0],Vd=[2,3],Hd=[3,2],Xg={L:Wg,M:Gd,Q:Vd,H:Hd},qg=/^\d*$/,$g=/^[A-Z0-9 $%*+./:-]*$/,Qc="0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ $%*+-./:",nh=1,sh=40,zd=3,Yg=3,Xo=40,Zg=10,Wd=[[-1,7,10,15,20,26,18,20,24,30,18,20,24,26,30,22,24,28,30,28,28,28,28,30,30,26,28,30,30,30,30,30,30,30,30,30,30,30,30,30,30],[-1,10,16,26,18,24,16,18,22,22,26,30,22,22,24,24,28,28,26,26,26,26,28,28,28,28,28,28,28,28,28,28,28,28,28,28,28,28,28,28,28],[-1,13,22,18,26,18,24,18,22,20,24,28,26,24,20,30,24,28,28,26,30,28,30,30,30,30,28,30,30,30,30,30,30,30,30,30,30,30,30,30,30],[-1,17,28,22,16,22,28,26,26,24,28,24,28,22,24,24,30,28,28,26,28,30,24,30,30,30,30,30,30,30,30,30,30,30,30,30,30,30,30,30,30]],Xd=[[-1,1,1,1,1,1,2,2,2,2,4,4,4,4,4,6,6,6,6,7,8,8,9,9,10,12,12,12,13,14,15,16,17,18,19,19,20,21,22,24,25],[-1,1,1,1,2,2,4,4,4,5,5,5,8,9,9,10,10,11,13,14,16,17,17,18,20,21,23,25,26,28,29,31,33,35,37,38,40,43,45,47,49],[-1,1,1,2,2,4,4,6,6,8,8,8,10,12,16,12,17,16,18,21,20,23,23,25,27,29,34,34,35,38,40,43,45,48,51,53,56,59,62,65,68],[-1,1,1,2,4,4,4,5,6,8,8,11,11,16,16,18,16,19,21,25,25,25,34,30,32,35,37,40,42,45,48,51,54,57,60,63,66,70,74,77,81]],th=class{constructor(t,e,i,n){if(this.version=t,this.ecc=e,t<nh||t>sh)throw new RangeError("Version value out of range");if(n<-1||n>7)throw new RangeError("Mask value out of range");this.size=t*4+17;let r=Array.from({length:this.size}).fill(!1);for(let a=0;a<this.size;a++)this.modules.push(r.slice()),this.types.push(r.map(()=>0));this.drawFunctionPatterns();let o=this.addEccAndInterleave(i);if(this.drawCodewords(o),n===-1){let a=1e9;for(let l=0;l<8;l++){this.applyMask(l),this.drawFormatBits(l);let c=this.getPenaltyScore();c<a&&(n=l,a=c),this.applyMask(l)}}this.mask=n,this.applyMask(n),this.drawFormatBits(n)}size;mask;modules=[];types=[];getModule(t,e){return t>=0&&t<this.size&&e>=0&&e<this.size&&this.modules[e][t]}drawFunctionPatterns(){for(let i=0;i<this.size;i++)this.setFunctionModule(6,i,i%2===0,zn.Timing),this.setFunctionModule(i,6,i%2===0,zn.Timing);this.drawFinderPattern(3,3),this.drawFinderPattern(this.size-4,3),this.drawFinderPattern(3,this.size-4);let t=this.getAlignmentPatternPositions(),e=t.length;for(let i=0;i<e;i++)for(let n=0;n<e;n++)i===0&&n===0||i===0&&n===e-1||i===e-1&&n===0||this.drawAlignmentPattern(t[i],t[n]);this.drawFormatBits(0),this.drawVersion()}drawFormatBits(t){let e=this.ecc[1]<<3|t,i=e;for(let r=0;r<10;r++)i=i<<1^(i>>>9)*1335;let n=(e<<10|i)^21522;for(let r=0;r<=5;r++)this.setFunctionModule(8,r,$i(n,r));this.setFunctionModule(8,7,$i(n,6)),this.setFunctionModule(8,8,$i(n,7)),this.setFunctionModule(7,8,$i(n,8));for(let r=9;r<15;r++)this.setFunctionModule(14-r,8,$i(n,r));for(let r=0;r<8;r++)this.setFunctionModule(this.size-1-r,8,$i(n,r));for(let r=8;r<15;r++)this.setFunctionModule(8,this.size-15+r,$i(n,r));this.setFunctionModule(8,this.size-8,!0)}drawVersion(){if(this.version<7)return;let t=this.version;for(let i=0;i<12;i++)t=t<<1^(t>>>11)*7973;let e=this.version<<12|t;for(let i=0;i<18;i++){let n=$i(e,i),r=this.size-11+i%3,o=Math.floor(i/3);this.setFunctionModule(r,o,n),this.setFunctionModule(o,r,n)}}drawFinderPattern(t,e){for(let i=-4;i<=4;i++)for(let n=-4;n<=4;n++){let r=Math.max(Math.abs(n),Math.abs(i)),o=t+n,a=e+i;o>=0&&o<this.size&&a>=0&&a<this.size&&this.setFunctionModule(o,a,r!==2&&r!==4,zn.Position)}}drawAlignmentPattern(t,e){for(let i=-2;i<=2;i++)for(let n=-2;n<=2;n++)this.setFunctionModule(t+n,e+i,Math.max(Math.abs(n),Math.abs(i))!==1,zn.Alignment)}setFunctionModule(t,e,i,n=zn.Function){this.modules[e][t]=i,this.types[e][t]=n}addEccAndInterleave(t){let e=this.version,i=this.ecc;if(t.length!==qo(e,i))throw new RangeError("Invalid argument");let n=Xd[i[0]][e],r=Wd[i[0]][e],o=Math.floor(eh(e)/8),a=n-o%n,l=Math.floor(o/n),c=[],h=s0(r);for(let d=0,f=0;d<n;d++){let p=t.slice(f,f+l-r+(d<a?0:1));f+=p.length;let _=r0(p,h);d<a&&p.push(0),c.push(p.concat(_))}let u=[];for(let d=0;d<c[0].length;d++)c.forEach((f,p)=>{(d!==l-r||p>=a)&&u.push(f[d])});return u}drawCodewords(t){if(t.length!==Math.floor(eh(this.version)/8))throw new RangeError("Invalid argument");let e=0;for(let i=this.size-1;i>=1;i-=2){i===6&&(i=5);for(let n=0;n<this.size;n++)for(let r=0;r<2;r++){let o=i-r,l=(i+1&2)===0?this.size-1-n:n;!this.types[l][o]&&e<t.length*8&&(this.modules[l][o]=$i(t[e>>>3],7-(e&7)),e++)}}}applyMask(t){if(t<0||t>7)throw new RangeError("Mask value out of range");for(let e=0;e<this.size;e++)for(let i=0;i<this.size;i++){let n;switch(t){case 0:n=(i+e)%2===0;break;case 1:n=e%2===0;break;case 2:n=i%3===0;break;case 3:n=(i+e)%3===0;break;case 4:n=(Math.floor(i/3)+Math.floor(e/2))%2===0;break;case 5:n=i*e%2+i*e%3===0;break;case 6:n=(i*e%2+i*e%3)%2===0;break;case 7:n=((i+e)%2+i*e%3)%2===0;break;default:throw new Error("Unreachable")}!this.types[e][i]&&n&&(this.modules[e][i]=!this.modules[e][i])}}getPenaltyScore(){let t=0;for(let r=0;r<this.size;r++){let o=!1,a=0,l=[0,0,0,0,0,0,0];for(let c=0;c<this.size;c++)this.modules[r][c]===o?(a++,a===5?t+=zd:a>5&&t++):(this.finderPenaltyAddHistory(a,l),o||(t+=this.finderPenaltyCountPatterns(l)*Xo),o=this.modules[r][c],a=1);t+=this.finderPenaltyTerminateAndCount(o,a,l)*Xo}for(let r=0;r<this.size;r++){let o=!1,a=0,l=[0,0,0,0,0,0,0];for(let c=0;c<this.size;c++)this.modules[c][r]===o?(a++,a===5?t+=zd:a>5&&t++):(this.finderPenaltyAddHistory(a,l),o||(t+=this.finderPenaltyCountPatterns(l)*Xo),o=this.modules[c][r],a=1);t+=this.finderPenaltyTerminateAndCount(o,a,l)*Xo}for(let r=0;r<this.size-1;r++)for(let o=0;o<this.size-1;o++){let a=this.modules[r][o];a===this.modules[r][o+1]&&a===this.modules[r+1][o]&&a===this.modules[r+1][o+1]&&(t+=Yg)}let e=0;for(let r of this.modules)e=r.reduce((o,a)=>o+(a?1:0),e);let i=this.size*this.size,n=Math.ceil(Math.abs(e*20-i*10)/i)-1;return t+=n*Zg,t}getAlignmentPatternPositions(){if(this.version===1)return[];{let t=Math.floor(this.version/7)+2,e=this.version===32?26:Math.ceil((this.version*4+4)/(t*2-2))*2,i=[6];for(let n=this.size-7;i.length<t;n-=e)i.splice(1,0,n);return i}}finderPenaltyCountPatterns(t){let e=t[1],i=e>0&&t[2]===e&&t[3]===e*3&&t[4]===e&&t[5]===e;return(i&&t[0]>=e*4&&t[6]>=e?1:0)+(i&&t[6]>=e*4&&t[0]>=e?1:0)}finderPenaltyTerminateAndCount(t,e,i){return t&&(this.finderPenaltyAddHistory(e,i),e=0),e+=this.size,this.finderPenaltyAddHistory(e,i),this.finderPenaltyCountPatterns(i)}finderPenaltyAddHistory(t,e){e[0]===0&&(t+=this.size),e.pop(),e.unshift(t)}};function Yi(s,t,e){if(t<0||t>31||s>>>t)throw new RangeError("Value out of range");for(let i=t-1;i>=0;i--)e.push(s>>>i&1)}function $i(s,t){return(s>>>t&1)!==0}var or=class{constructor(t,e,i){if(this.mode=t,this.numChars=e,this.bitData=i,e<0)throw new RangeError("Invalid argument");this.bitData=i.slice()}getData(){return this.bitData.slice()}},Jg=[1,10,12,14],jg=[2,9,11,13],Kg=[4,8,16,16];function qd(s,t){return s[Math.floor((t+7)/17)+1]}function $d(s){let t=[];for(let e of s)Yi(e,8,t);return new or(Kg,s.length,t)}function Qg(s){if(!Yd(s))throw new RangeError("String contains non-numeric characters");let t=[];for(let e=0;e<s.length;){let i=Math.min(s.length-e,3);Yi(Number.parseInt(s.substring(e,e+i),10),i*3+1,t),e+=i}return new or(Jg,s.length,t)}function t0(s){if(!Zd(s))throw new RangeError("String contains unencodable characters in alphanumeric mode");let t=[],e;for(e=0;e+2<=s.length;e+=2){let i=Qc.indexOf(s.charAt(e))*45;i+=Qc.indexOf(s.charAt(e+1)),Yi(i,11,t)}return e<s.length&&Yi(Qc.indexOf(s.charAt(e)),6,t),new or(jg,s.length,t)}function e0(s){return s===""?[]:Yd(s)?[Qg(s)]:Zd(s)?[t0(s)]:[$d(n0(s))]}function Yd(s){return qg.test(s)}function Zd(s){return $g.test(s)}function i0(s,t){let e=0;for(let i of s){let n=qd(i.mode,t);if(i.numChars>=1<<n)return Number.POSITIVE_INFINITY;e+=4+n+i.bitData.length}return e}function n0(s){s=encodeURI(s);let t=[];for(let e=0;e<s.length;e++)s.charAt(e)!=="%"?t.push(s.charCodeAt(e)):(t.push(Number.parseInt(s.substring(e+1,e+3),16)),e+=2);return t}function eh(s){if(s<nh||s>sh)throw new RangeError("Version number out of range");let t=(16*s+128)*s+64;if(s>=2){let e=Math.floor(s/7)+2;t-=(25*e-10)*e-55,s>=7&&(t-=36)}return t}function qo(s,t){return Math.floor(eh(s)/8)-Wd[t[0]][s]*Xd[t[0]][s]}function s0(s){if(s<1||s>255)throw new RangeError("Degree out of range");let t=[];for(let i=0;i<s-1;i++)t.push(0);t.push(1);let e=1;for(let i=0;i<s;i++){for(let n=0;n<t.length;n++)t[n]=ih(t[n],e),n+1<t.length&&(t[n]^=t[n+1]);e=ih(e,2)}return t}function r0(s,t){let e=t.map(i=>0);for(let i of s){let n=i^e.shift();e.push(0),t.forEach((r,o)=>e[o]^=ih(r,n))}return e}function ih(s,t){if(s>>>8||t>>>8)throw new RangeError("Byte out of range");let e=0;for(let i=7;i>=0;i--)e=e<<1^(e>>>7)*285,e^=(t>>>i&1)*s;return e}function o0(s,t,e=1,i=40,n=-1,r=!0){if(!(nh<=e&&e<=i&&i<=sh)||n<-1||n>7)throw new RangeError("Invalid value");let o,a;for(o=e;;o++){let u=qo(o,t)*8,d=i0(s,o);if(d<=u){a=d;break}if(o>=i)throw new RangeError("Data too long")}for(let u of[Gd,Vd,Hd])r&&a<=qo(o,u)*8&&(t=u);let l=[];for(let u of s){Yi(u.mode[0],4,l),Yi(u.numChars,qd(u.mode,o),l);for(let d of u.getData())l.push(d)}let c=qo(o,t)*8;Yi(0,Math.min(4,c-l.length),l),Yi(0,(8-l.length%8)%8,l);for(let u=236;l.length<c;u^=253)Yi(u,8,l);let h=Array.from({length:Math.ceil(l.length/8)},()=>0);return l.forEach((u,d)=>h[d>>>3]|=u<<7-(d&7)),new th(o,t,h,n)}function Jd(s,t){let{ecc:e="L",boostEcc:i=!1,minVersion:n=1,maxVersion:r=40,maskPattern:o=-1,border:a=1}=t||{},l=typeof s=="string"?e0(s):Array.isArray(s)?[$d(s)]:void 0;if(!l)throw new Error(`uqr only supports encoding string and binary data, but got: ${typeof s}`);let c=o0(l,Xg[e],n,r,o,i),h=a0({version:c.version,maskPattern:c.mask,size:c.size,data:c.modules,types:c.types},a);return t?.invert&&(h.data=h.data.map(u=>u.map(d=>!d))),t?.onEncoded?.(h),h}function a0(s,t=1){if(!t)return s;let{size:e}=s,i=e+t*2;s.size=i,s.data.forEach(r=>{for(let o=0;o<t;o++)r.unshift(!1),r.push(!1)});for(let r=0;r<t;r++)s.data.unshift(Array.from({length:i},o=>!1)),s.data.push(Array.from({length:i},o=>!1));let n=zn.Border;s.types.forEach(r=>{for(let o=0;o<t;o++)r.unshift(n),r.push(n)});for(let r=0;r<t;r++)s.types.unshift(Array.from({length:i},o=>n)),s.types.push(Array.from({length:i},o=>n));return s}function ar(s,t){let e=document.createElement("dialog"),i=document.createElement("header"),n=document.createElement("h2"),r=document.createElement("button");e.className="sheet",e.setAttribute("aria-label",s),n.textContent=s,i.append(n,r),Object.assign(r,{type:"button",className:"close",textContent:"Close"}),r.addEventListener("click",()=>e.close()),e.addEventListener("click",({target:o})=>o===e&&e.close()),e.addEventListener("keydown",o=>o.stopPropagation()),e.addEventListener("close",()=>e.remove()),e.append(i,t),document.body.append(e),e.showModal()}var l0=2900,jd="http://www.w3.org/2000/svg",c0=4,h0=["","localhost","127.0.0.1","[::1]"];function u0(s){let{data:t,size:e}=Jd(s,{ecc:"L",border:c0}),i=document.createElementNS(jd,"svg"),n=document.createElementNS(jd,"path"),r=t.flatMap((o,a)=>o.flatMap((l,c)=>l?[`M${c} ${a}h1v1h-1z`]:[]));return i.setAttribute("viewBox",`0 0 ${e} ${e}`),i.setAttribute("role","img"),i.setAttribute("aria-label","QR code of the address of this setting"),i.setAttribute("shape-rendering","crispEdges"),n.setAttribute("d",r.join("")),i.append(n),i}function Kd(s){let t=document.createElement("div"),e=document.createElement("p"),{hostname:i}=new URL(s);if(s.length>l0){e.textContent="The address is too long for a code. Copy the link instead.",t.append(e),ar("QR code",t);return}e.textContent=h0.includes(i)?"This page is on this computer alone: a phone can open the code once the page is on a web server.":"Point a phone's camera at the code: it opens this page with this setting.",t.append(u0(s),e),ar("QR code",t)}var Qd={t:"s",x:"m",x_dot:"m/s",quat_xyzw:"1",y:"1",y_dot:"1/s",thrust:"N",rotor_forces:"N",x_ref:"m",clearance:"m"},d0={quat_xyzw:"quat",rotor_forces:"rotor_force"};function f0(s,t){let e=t===1?[""]:s==="quat_xyzw"?["_x","_y","_z","_w"]:Array.from({length:t},(n,r)=>`_${r+1}`),i=Qd[s]?` [${Qd[s]}]`:"";return e.map(n=>`${d0[s]??s}${n}${i}`)}function tf(s){let t=Object.keys(s.columns).filter(o=>o!=="excess"),e=s.t.length,i=o=>s.columns[o].length/e,n=t.flatMap(o=>f0(o,i(o))).join(","),r=Array.from({length:e},(o,a)=>t.flatMap(l=>s.sample(l,a,i(l))).join(","));return new Blob([`${[n,...r].join(`
`)}
`],{type:"text/csv"})}var p0=`<h2>Keep</h2>
  <div class="row two"><button type="button" data-keep="csv" title="Times, states, forces of the flight that is shown">CSV</button>
  <button type="button" data-keep="png" title="The picture as it is, in the size of movies">PNG</button></div>
  <div class="row two"><button type="button" data-keep="link" title="An address that leads to this setting">Copy link</button>
  <button type="button" data-keep="embed" title="The line of HTML that shows this setting in another page">Copy embed code</button></div>
  <div class="row two"><button type="button" data-keep="code" title="The address of this setting as a QR code">QR code</button>
  <button type="button" data-keep="kiosk" title="For an exhibition: the swing-up again and again, and a game against the controller (k)">Kiosk</button></div>
  <div class="row two"><button type="button" data-keep="pin" aria-pressed="false" title="Leave the flight as a ghost while the setting changes">Pin</button></div>`,m0=(s,t)=>{let e=document.createElement("iframe");for(let[i,n]of Object.entries({src:s,title:t,width:960,height:640,loading:"lazy",style:"border:0"}))e.setAttribute(i,n);return e.outerHTML},$o=class{constructor(t){this.lab=t;let e=document.createElement("section");e.innerHTML=p0,t.panel.root.append(e);for(let i of e.querySelectorAll("[data-keep]"))i.addEventListener("click",()=>this[i.dataset.keep](i));t.panel.pin=e.querySelector("[data-keep=pin]"),t.panel.pins(t.pinned.length>0)}csv(){let{flights:t}=this.lab.viewer;rr(tf(t[0]),"flight.csv")}png(){let{viewer:t}=this.lab;t.stage&&Bd(t,t.size,e=>rr(e,"flight.png"))}link(t){this.#t(t,e=>e,"See the address bar")}embed(t){this.#t(t,e=>m0(e,this.lab.viewer.title),"No clipboard here")}code(){this.lab.setting.keep(),Kd(location.href)}kiosk(){this.lab.exhibit()}#t(t,e,i){let n=t.dataset.words??=t.textContent;this.lab.setting.keep(),(navigator.clipboard?.writeText(e(location.href))??Promise.reject(new Error("no clipboard"))).then(()=>"Copied",()=>i).then(o=>{t.textContent=o,setTimeout(()=>t.textContent=n,1500)})}pin(){this.lab.pin()}};var g0=window.matchMedia("(prefers-reduced-motion: reduce)"),Ni=()=>g0.matches;var x0=[["Picture","Drag to look around, pinch or wheel to zoom, double tap to reset"],["Plots and phase portrait","Touch to go to that time"],["Ball","In a live flight, drag and fling it; at the start, drag it to another start"],["\u2190, \u2192","Step by 1/30 s, with shift by 1 s; \u2191 and \u2193 change the speed"]];function rh(s){let t=document.createElement("dl"),e=new Set,i=[...s.querySelectorAll(":is(button, a)[title]:not([title=''], .handle)")].map(n=>[_0(n),n.title]);for(let[n,r]of[...x0,...i])e.has(r)||(e.add(r),t.append(Object.assign(document.createElement("dt"),{textContent:n}),Object.assign(document.createElement("dd"),{textContent:r})));ar("What everything does",t)}function _0(s){let t=s.textContent.trim()||s.getAttribute("aria-label"),e=s.closest("[data-whose]");return e?`${e.dataset.whose} ${t}`:t}var Yo=class{constructor(t,e=()=>!1){let{clock:i}=t;Object.assign(this,{viewer:t,settled:e,speed:i.speed}),i.loop=!0,i.play(),this.leave=({target:n})=>!n.closest?.("canvas.picture")&&t.take();for(let n of["pointerdown","keydown"])document.addEventListener(n,this.leave,!0)}frame(){let{viewer:{clock:t,flights:[e]}}=this,{settling:i}=e.verdict,r=e.phases.some(({name:o,from:a,to:l})=>o==="flips"&&t.time>a-.25&&t.time<l+.25)?.25*this.speed:this.speed;t.speed!==r&&t.setSpeed(r),i!==null&&t.time>i+.25&&this.settled()&&this.viewer.take()}end(){let{viewer:{clock:t}}=this;t.loop=!1,t.setSpeed(this.speed);for(let e of["pointerdown","keydown"])document.removeEventListener(e,this.leave,!0)}};var we=46,di=12,bi=8,fn=20,ef=92,v0=9,y0=1e-8,b0=Number.MIN_VALUE,M0=10,S0=4,Zo=class{constructor(t,e,i){this.root=document.createElement("figure"),this.root.className="plot",this.root.innerHTML=`<figcaption><span class="what"></span><span class="values"></span></figcaption>
      <div class="area"><canvas></canvas><i class="cursor"></i></div>`,t.append(this.root);let n=r=>this.root.querySelector(r);this.area=n(".area"),this.canvas=n("canvas"),this.cursor=n(".cursor"),this.canvas.setAttribute("role","img"),this.#n(i),this.load(e)}load(t){Object.assign(this,{names:[],levels:[],limits:[null,null],range:null,wide:!1,scale:0,least:0,touches:[],phases:[],log:!1,...t}),this.log&&Object.assign(this,T0(this)),this.#e(),this.root.classList.toggle("wide",this.wide),[this.span,this.peak]=this.range?[this.range,null]:E0(this),this.canvas.setAttribute("aria-label",this.#t())}#t(){let{plain:t,unit:e,span:[i,n],limits:[r,o],peak:a}=this,l=this.log?Fo:vi,c=d=>`${l(d)}${e&&` ${e}`}`,h=o!==null&&o<n?`; rotor limit ${c(o)}`:r!==null&&r>i?`; least rotor force ${c(r)}`:"",u=this.phases.map(({from:d,name:f})=>`${f} from ${d.toFixed(1)} s`).join(", ");return`${t} over time, ${l(i)} to ${c(n)}${u&&`; the rod ${u}`}${h}${a?`; cut off, peak ${ko(a)}${e}`:""}`}#e(){let{title:t,unit:e}=this,i=this.lines.filter(r=>r.label),n=JSON.stringify([t,e,i.map(({label:r,role:o,mark:a})=>[r,o,a])]);if(n===this.same)this.readings.forEach((r,o)=>r.line=i[o]);else{this.same=n,this.root.querySelector(".what").innerHTML=e?`${t} (${e})`:t;let r=this.root.querySelector(".values");r.replaceChildren(),this.readings=i.map(o=>this.#i(r,o))}}#i(t,e){let i=document.createElement("span");return i.style.setProperty("--tone",`var(--${e.role})`),i.innerHTML=`${Md(e.mark)}<b>${e.label}</b> <output></output>`,t.append(i),{line:e,output:i.querySelector("output")}}#n(t){let e=i=>{let{left:n}=this.canvas.getBoundingClientRect();t(Ke(this.start,this.end,Te(((i.clientX-n)/this.larger-we)/(this.width-we-di),0,1)))};this.area.addEventListener("pointerdown",i=>{this.area.setPointerCapture(i.pointerId),e(i)}),this.area.addEventListener("pointermove",i=>i.buttons&&e(i)),new ResizeObserver(([{contentRect:{width:i,height:n}}])=>{let r=si();Object.assign(this,{larger:r,width:i/r,height:n/r}),this.colours&&this.draw(this.colours),this.show(this.now??this.start,!1)}).observe(this.area)}draw(t){this.colours=t;let{width:e,height:i}=this;if(!e||!i)return;let n=this.canvas.getContext("2d");rs(n,e,i);let[r,o]=this.span,a={x:l=>we+(l-this.start)/(this.end-this.start||1)*(e-we-di),y:l=>bi+(o-l)/(o-r)*(i-bi-fn)};this.#o(n,a,t),n.save(),n.beginPath(),n.rect(we,bi-2,e-we-di,i-bi-fn+4),n.clip();for(let l of this.lines)w0(n,a,l,t);this.#s(n,a,t),n.restore(),this.#a(n,a,t)}#s(t,e,i){let n=this.lines.filter(o=>o.mark),r=this.width-we-di;n.forEach((o,a)=>{for(let l=(a+.5)*ef/n.length;l<r;l+=ef){let c=Ke(this.start,this.end,l/r);if(c>o.t[o.t.length-1])break;bd(t,o.mark,we+l,e.y(oh(o,c)),i[o.role],i.paper)}})}#r(t,e,i){let{width:n,height:r,span:[o,a],limits:[l,c]}=this,h=(u,d)=>{let f=Math.max(e.y(d),bi),p=Math.min(e.y(u),r-fn);t.fillStyle=i.barred,p>f&&t.fillRect(we,f,n-we-di,p-f)};c!==null&&c<a&&h(c,a),l!==null&&l>o&&h(o,l)}#o(t,e,i){let{width:n,height:r,span:[o,a]}=this;this.#r(t,e,i),t.font=Lo(11),Object.assign(t,{lineWidth:1,textBaseline:"middle"});let l=(c,h,u,d,f,p=[])=>{t.setLineDash(p),t.strokeStyle=f,t.beginPath(),t.moveTo(c,h),t.lineTo(u,d),t.stroke(),t.setLineDash([])};t.fillStyle=i.muted,t.textAlign="right";for(let c of nf(o,a,this.range&&!this.log?3:Math.max(2,Math.floor(r/34)),this.log?1:0))l(we,e.y(c),n-di,e.y(c),i.line),t.fillText((this.log?Fo:vi)(c),we-7,e.y(c));t.textBaseline="alphabetic";for(let c of nf(this.start,this.end,Math.max(3,Math.floor(n/75)))){l(e.x(c),bi,e.x(c),r-fn,i.line);let h=e.x(c)>n-di-14;t.textAlign=h?"right":"center",t.fillText(h?`${vi(c)} s`:vi(c),h?n-2:e.x(c),r-5)}for(let[c]of this.levels)l(we,e.y(c),n-di,e.y(c),i.muted,[2,3]);for(let{left:c,right:h}of this.#c(t,e))for(let u of[c,h])u>we+1&&u<n-di-1&&l(u,bi,u,r-fn,i.muted,[1,3]);for(let c of this.touches)l(e.x(c),bi,e.x(c),r-fn,i.failed,[4,2])}#a(t,e,i){let{width:n,height:r,span:[o,a]}=this,l=n-di-4,c=(bi+r-fn)/2+4;Object.assign(t,{textAlign:"right",textBaseline:"alphabetic",lineWidth:4,fillStyle:i.muted});let h=[],u=(_,m,g,b=i.paper)=>{h.push({y:m,right:g,left:g-t.measureText(_).width}),t.strokeStyle=b,t.strokeText(_,g,m),t.fillText(_,g,m)};for(let{name:_,left:m,right:g,size:b}of this.#c(t,e))u(_,c,(m+g+b)/2);if(this.peak){let _=`cut off, peak ${ko(this.peak)}${this.unit}`;u(_,bi+10,we+6+t.measureText(_).width)}let d=(_,m,g)=>{let b=t.measureText(_).width,E=({y:x,right:S})=>x>bi+8&&x<r-fn-2&&h.every(U=>Math.abs(U.y-x)>12||U.left>S||U.right<S-b),M=[l,we+4+b,(we+l+b)/2].flatMap(x=>m.map(S=>({y:S,right:x}))).filter(E),T=M.map(x=>this.#l(e,x.right-b,x.right,x.y-4)),A=M[T.indexOf(Math.min(...T))];A&&u(_,A.y,A.right,A.y===m[0]?g:i.paper)},[f,p]=this.limits;p!==null&&p<a?d(`Rotor limit ${vi(p)} ${this.unit}`,[e.y(p)-5,e.y(p)+14],i.barred):f!==null&&f>o&&d(`Least rotor force ${vi(f)} ${this.unit}`,[e.y(f)+14],i.barred);for(let[_,m]of this.levels)d(m,[e.y(_)-6,e.y(_)+14]);for(let[_,m]of this.names)d(m,[e.y(_)+(_>(o+a)/2?15:-7)])}#l(t,e,i,n){let{lines:r,start:o,end:a,width:l}=this,c=0;for(let h=0;h<=8;h++){let u=Ke(o,a,(Ke(e,i,h/8)-we)/(l-we-di));for(let d of r)c+=u<=d.t[d.t.length-1]&&Math.abs(t.y(oh(d,u))-n)<v0}return c}#c(t,e){return this.phases.map(({from:i,to:n,name:r})=>({name:r,left:e.x(Math.max(i,this.start)),right:e.x(n),size:t.measureText(r).width})).filter(({left:i,right:n,size:r})=>n-i>r+6)}show(t,e=!0){this.now=t;let i=(Te(t,this.start,this.end)-this.start)/(this.end-this.start||1);if(Pi(this.cursor,`translateX(${(this.larger??1)*(we+i*((this.width??0)-we-di))}px)`),!!e)for(let{line:n,output:r}of this.readings)Se(r,(this.log?Ed:Ad)(oh(n,t)))}};function w0(s,t,e,i){Object.assign(s,{strokeStyle:i[e.role],lineWidth:e.width??1.6,lineJoin:"round"}),s.globalAlpha=e.opacity??1,s.setLineDash(e.dash??[]),s.beginPath(),e.t.forEach((n,r)=>s.lineTo(t.x(n),t.y(e.values[r]))),s.stroke(),s.setLineDash([]),s.globalAlpha=1}function oh({t:s,values:t},e){let i=Math.min(Qe(s,e),Math.max(s.length-2,0)),n=Math.min(i+1,s.length-1),r=s[n]>s[i]?Te((e-s[i])/(s[n]-s[i]),0,1):0;return Ke(t[i],t[n],r)}function E0({lines:s,levels:t,limits:e,scale:i,least:n}){let r=Math.max(...s.map(d=>d.values.reduce((f,p)=>Math.max(f,Math.abs(p)),0))),o=i||A0(s),a=r>M0*o&&o>0?S0*o:1/0,[l,c]=[0,n],h=d=>{l=Math.min(l,Te(d,-a,a)),c=Math.max(c,Te(d,-a,a))};s.forEach(d=>d.values.forEach(h)),t.forEach(([d])=>h(d)),e[1]!==null&&e[1]<1.6*c&&h(1.12*e[1]);let u=.06*(c-l)||1;return[[l<0?l-u:l,c+u],Number.isFinite(a)?r:null]}function A0(s){let t=s.flatMap(({t:i,values:n})=>Array.from(n,(r,o)=>[Math.abs(r),o?i[o]-i[o-1]:0])).sort((i,n)=>i[0]-n[0]),e=.95*t.reduce((i,[,n])=>i+n,0);return(t.find(([,i])=>(e-=i)<=0)??t[0])[0]}function T0({lines:s,least:t}){let e=s.reduce((a,{values:l})=>l.reduce((c,h)=>h>c?h:c,a),t),i=s.map(a=>({...a,values:a.values.map(l=>Math.log10(Math.max(l,b0)))})),n=i.reduce((a,{values:l})=>l.reduce((c,h)=>Math.min(c,h),a),Math.log10(e)),r=Math.ceil(Math.log10(e)),o=Math.log10(y0*e);return{lines:i,range:[Math.min(Math.floor(Math.max(n,o)),r-1),r]}}function nf(s,t,e,i=0){let n=Math.max(Ii((t-s)/e||1),i),r=Math.ceil(s/n-1e-9);return Array.from({length:Math.floor(t/n+1e-9)-r+1},(o,a)=>(r+a)*n)}var R0=[30,60,90,120,150],C0=90;function pn([s,t,e],i=1){let n=Math.hypot(s,t),r=Math.sqrt(Math.max(1-i*e,0)/2);return n>1e-9?[r*s/n,-r*t/n]:[r,0]}function sf([s,t]){let e=s*s+t*t,i=2*Math.sqrt(1-e);return e<=1?[s*i,-t*i,1-2*e]:null}var I0=(s,t,e,i)=>Math.hypot(e-s,i-t)>.5;function lr(s,t,e,i=0){s.beginPath();for(let n=2*i;n<t.length;n+=2){let[r,o]=[e*t[n],e*t[n+1]];n===2*i||I0(t[n-2],t[n-1],t[n],t[n+1])?s.moveTo(r,o):s.lineTo(r,o)}s.stroke()}function Jo(s,t,e,i){let n=(r,o,a)=>{Object.assign(s,{lineWidth:o,strokeStyle:a}),s.beginPath(),s.arc(0,0,t*r,0,2*Math.PI),s.stroke()};for(let r of R0)n(Math.sin(r*Math.PI/360),r===C0?2:1,e);n(1,1,i)}function jo(s,t,e,i){Object.assign(s,{font:Lo(12),textAlign:"center",textBaseline:"middle",fillStyle:i}),s.fillText("e\u2081",t+15,0),s.fillText("e\u2082",0,(e==="up"?-1:1)*(t+15))}var P0=.2,L0=24,N0=20,D0=.85,U0=`<div class="globe"><canvas role="img"></canvas><i class="hand"></i></div>
  <figcaption><button type="button" class="fold" title="The direction of the rod on its sphere (s)">Rod direction</button>
  <span class="lean"><output></output> from upright, <output></output> rad/s</span>
  <button type="button" class="over">\u21C5</button></figcaption>`,Ko=class{constructor(t,e){this.root=document.createElement("figure"),Object.assign(this.root,{className:"portrait",innerHTML:U0,hidden:!0}),t.append(this.root);let i=n=>this.root.querySelector(n);Object.assign(this,{globe:i(".globe"),canvas:i("canvas"),hand:i(".hand"),button:i(".fold"),over:i(".over"),dots:[],flights:[]}),this.outputs=[...this.root.querySelectorAll("output")],this.context=this.canvas.getContext("2d"),new ResizeObserver(([{contentRect:{width:n}}])=>{let r=si(),o=n/r;Object.assign(this,{larger:r,size:o,radius:o/2-L0}),this.colours&&this.seen&&this.draw(this.colours),this.poses&&this.show(this.poses,!1)}).observe(this.globe),this.globe.addEventListener("pointerdown",n=>this.#l(n,e)),this.button.addEventListener("click",()=>this.fold()),this.over.addEventListener("click",()=>{this.#e(-this.pole),this.#i()}),this.fold(!1)}get seen(){return this.flights.length>0&&!this.folded&&this.radius>0}fold(t=!this.folded){this.folded=t,this.button.setAttribute("aria-expanded",String(!t));for(let e of[this.globe,...this.root.querySelectorAll(".lean, .over")])e.hidden=t;this.flights.length&&this.#i()}load(t,e=-1/0){let[i]=t,n=`${i.law} ${i.e3}`;Object.assign(this,{flights:t,since:e}),this.kind!==n&&this.#e(ni(i.sample("y",i.t.length-1),i.e3)[2]<0?-1:1),this.kind=n;for(let r of this.dots.splice(t.length))r.remove();for(;this.dots.length<t.length;)this.dots.push(this.#t());this.root.hidden=!1,!this.folded&&(this.paths=t.map((r,o)=>rf(r,o?-1/0:e,this.pole)),this.times=i.t.slice(Qe(i.t,e)),this.#n())}#t(){let t=document.createElement("i");return t.className=this.dots.length?"rod ghost":"rod",this.canvas.after(t),t}#e(t){this.pole=t,this.rim=t===1?"hanging":"upright",this.over.title=this.over.ariaLabel=`Put ${this.rim} in the middle`}#i(){this.load(this.flights,this.since),this.colours&&this.draw(this.colours),this.poses&&this.show(this.poses)}#n(){let t=(i,n)=>On(ni(i.sample("y",n),i.e3)[2]).toFixed(0),e=`Path of the rod over the sphere of directions: ${this.flights.map((i,n)=>`${this.flights.length>1?`${i.title} `:""}from ${t(i,n?0:Qe(i.t,this.since))}\xB0 to ${t(i,i.t.length-1)}\xB0 from upright`).join("; ")}`;e!==this.words&&this.canvas.setAttribute("aria-label",e),this.words=e}draw(t){if(this.colours=t,!this.seen)return;let{context:e,size:i}=this;rs(e,i,i),e.translate(i/2,i/2),Object.assign(e,{fillStyle:t.sky,globalAlpha:D0}),e.beginPath(),e.arc(0,0,this.radius,0,2*Math.PI),e.fill(),e.globalAlpha=1,Jo(e,this.radius,`${t.grid}60`,t.muted),jo(e,this.radius,this.flights[0].e3,t.muted),e.fillText(`outer edge: ${this.rim}`,0,(this.flights[0].e3==="up"?1:-1)*(this.radius+15));for(let n=this.flights.length-1;n>=0;n--)this.#s(n),lr(e,this.paths[n],this.radius),this.#r(this.paths[n],t);this.drawn=this.flights[0].end}#s(t){let{context:e,colours:i}=this;Object.assign(e,{strokeStyle:t?i.ghost:i.rod,lineWidth:t?1.3:1.8,lineJoin:"round"}),e.setLineDash(ir[t])}#r([t,e],i){let{context:n,radius:r}=this;n.setLineDash([]),n.beginPath(),n.arc(r*t,r*e,4,0,2*Math.PI),n.fillStyle=i.sky,n.fill(),n.stroke()}grow(){let[t]=this.flights;!this.seen||t.end<=this.drawn||(this.#s(0),lr(this.context,rf(t,this.drawn,this.pole),this.radius),this.drawn=t.end)}show(t,e=!0){this.poses=t;let[{y:i,y_dot:n}]=t,{e3:r}=this.flights[0];e&&(Se(this.outputs[0],`${On(ni(i,r)[2]).toFixed(0)}\xB0`),Se(this.outputs[1],Math.hypot(...n).toFixed(1))),this.seen&&(t.forEach((o,a)=>{let[l,c]=this.#a(ni(o.y,this.flights[a].e3));Pi(this.dots[a],`translate(${l.toFixed(1)}px, ${c.toFixed(1)}px)`)}),this.#o(ni(i,r),ni(n,r)))}#o(t,e){let i=t.map((p,_)=>p+P0*e[_]),n=Math.hypot(...i),r=pn(t,this.pole),o=pn(i.map(p=>p/n),this.pole),[a,l]=this.#a(t),c=this.larger*this.radius,h=c*(o[0]-r[0]),u=c*(o[1]-r[1]),d=Math.hypot(h,u),f=d>c?0:d;Pi(this.hand,`translate(${a.toFixed(1)}px, ${l.toFixed(1)}px) rotate(${Math.atan2(u,h).toFixed(3)}rad) scaleX(${f.toFixed(1)})`)}#a(t){return pn(t,this.pole).map(e=>this.larger*(this.size/2+this.radius*e))}#l(t,e){let{left:i,top:n}=this.globe.getBoundingClientRect(),[r]=this.paths,[o,a]=[t.clientX-i,t.clientY-n].map(h=>(h/this.larger-this.size/2)/this.radius),l=0,c=1/0;for(let h=0;h<r.length;h+=2){let u=Math.hypot(r[h]-o,r[h+1]-a);u<c&&([l,c]=[h/2,u])}c*this.radius<N0&&e(this.times[l])}};function rf(s,t,e){let i=Qe(s.t,t),n=new Float64Array(2*(s.t.length-i));for(let r=i;r<s.t.length;r++)n.set(pn(ni(s.sample("y",r),s.e3),e),2*(r-i));return n}function of(s,t,e){let i=new Map,n=0,r=()=>{let[f,p]=[...i.values()];return Math.hypot(f.x-p.x,f.y-p.y)},o=f=>{s.setPointerCapture(f.pointerId),i.set(f.pointerId,{x:f.clientX,y:f.clientY}),i.size===2&&(n=r())},a=f=>{let p=i.get(f.pointerId);if(!p)return;let _={x:f.clientX,y:f.clientY};if(i.set(f.pointerId,_),i.size===1&&t.move(-.007*(_.x-p.x),.007*(_.y-p.y)),i.size===2){let m=r();t.move(0,0,m/Math.max(n,1)),n=m}e()},l=f=>i.delete(f.pointerId),c=self!==top,h=f=>{c&&!f.ctrlKey||(f.preventDefault(),t.move(0,0,Math.exp(-.0015*f.deltaY)),e())},d={pointerdown:o,pointermove:a,pointerup:l,pointercancel:l,lostpointercapture:l,dblclick:()=>{t.choose(t.preset),e()}};for(let[f,p]of Object.entries(d))s.addEventListener(f,p);s.addEventListener("wheel",h,{passive:!1})}var af=32,ah=["overview","side","follow","axis"],O0=.16,lf=.06,Qo=class{constructor(t,e,i){Object.assign(this,{direction:t,reach:e,box:i,zoom:1,preset:"follow",aspect:1}),this.now=null}choose(t){return ah.includes(t)?(Object.assign(this,{preset:t,zoom:1,turn:0,lift:0}),!0):!1}move(t,e,i=1){this.turn+=t,this.lift=Te(this.lift+e,-Math.PI/2-this.#t().elevation,Math.PI/2-this.#t().elevation),this.zoom=Te(this.zoom*i,.15,12),this.now&&Object.assign(this.now,this.#i(),{follow:this.now.follow})}#t(){let t=Math.atan2(this.direction[1],this.direction[0]),e=Math.tan(af*Math.PI/360),i=1.3*this.reach/e,n=t-Math.PI/2;if(this.preset==="overview"){let r={azimuth:n-.3,elevation:.2};return{...r,distance:Math.max(this.#e(r,e),i),follow:0}}return this.preset==="side"?{azimuth:n,elevation:.21,distance:1.15*i,follow:1}:this.preset==="axis"?{azimuth:-Math.PI/2,elevation:Math.PI/2,distance:1.15*i,follow:1}:{azimuth:n-.75,elevation:.3,distance:1.2*i,follow:1}}#e(t,e){let{right:i,up:n,back:r}=cf(t),{half:o}=this.box,a=.6*this.reach,l=e*Math.max(this.aspect,1)-lf,c=e*Math.max(1/this.aspect,1)-lf,h=[-1,1].flatMap(u=>[-1,1].flatMap(d=>[-1,1].map(f=>[u*o[0],d*o[1],f*o[2]])));return Math.max(...h.map(u=>ye(u,r)+Math.max((Math.abs(ye(u,i))+a)/l,(Math.abs(ye(u,n))+a)/c)))}#i(){let t=this.#t();return{azimuth:t.azimuth+this.turn,elevation:t.elevation+this.lift,distance:t.distance/this.zoom,follow:t.follow}}glide(t){let e=this.#i();if(!this.now||t===1/0)return this.now=e,!1;let i=1-Math.exp(-t/O0),{now:n}=this,r=((e.azimuth-n.azimuth+Math.PI)%(2*Math.PI)+2*Math.PI)%(2*Math.PI)-Math.PI;return Math.abs(r)+Math.abs(e.elevation-n.elevation)+Math.abs(Math.log(e.distance/n.distance))+Math.abs(e.follow-n.follow)<.001?(this.now=e,!1):(n.azimuth+=i*r,n.elevation=Ke(n.elevation,e.elevation,i),n.distance*=(e.distance/n.distance)**i,n.follow=Ke(n.follow,e.follow,i),!0)}target(t){return this.box.centre.map((e,i)=>Ke(e,t[i],this.now.follow))}apply(t,e,i){let{distance:n}=this.now,r=this.target(e),{back:o,up:a,right:l}=cf(this.now);t.matrix.set(l[0],a[0],o[0],r[0]+n*o[0],l[1],a[1],o[1],r[1]+n*o[1],l[2],a[2],o[2],r[2]+n*o[2],0,0,0,1),t.matrix.decompose(t.position,t.quaternion,t.scale);let c=Math.tan(af*Math.PI/360)*(i<1?1/i:1);return Object.assign(t,{aspect:i,fov:360/Math.PI*Math.atan(c),near:.02*n,far:60*n}),t.updateProjectionMatrix(),t.updateMatrixWorld(!0),{target:r,distance:n,back:o,up:a,right:l,follow:this.now.follow}}};function cf({azimuth:s,elevation:t}){let[e,i,n,r]=[Math.cos(s),Math.sin(s),Math.cos(t),Math.sin(t)];return{back:[n*e,n*i,r],up:[-r*e,-r*i,n],right:[-i,e,0]}}/**
 * @license
 * Copyright 2010-2026 Three.js Authors
 * SPDX-License-Identifier: MIT
 */var Yf=0,Yh=1,Zf=2;var Jn=1,Jf=2,Fs=3,Rn=0,ze=1,Ie=2,jn=0,ks=1,Zh=2,Jh=3,jh=4,jf=5;var Kn=100,Kf=101,Qf=102,tp=103,ep=104,ip=200,np=201,sp=202,rp=203,Kh=204,Qh=205,op=206,ap=207,lp=208,cp=209,hp=210,up=211,dp=212,fp=213,pp=214,Ca=0,Ia=1,Pa=2,Ms=3,La=4,Na=5,Da=6,Ua=7,ml=0,mp=1,gp=2,Gi=0,tu=1,eu=2,iu=3,nu=4,su=5,ru=6,ou=7;var au=300,Qn=301,Bs=302,gl=303,xl=304,Oa=1e3,Ui=1001,Fa=1002,Fe=1003,xp=1004;var so=1005;var Je=1006,_l=1007;var rn=1008;var ii=1009,lu=1010,cu=1011,zs=1012,vl=1013,Ti=1014,xi=1015,Ri=1016,yl=1017,bl=1018,ts=1020,hu=35902,uu=35899,du=1021,fu=1022,Ci=1023,en=1026,on=1027,Ml=1028,Sl=1029,Cn=1030,wl=1031;var El=1033,ro=33776,oo=33777,ao=33778,lo=33779,Al=35840,Tl=35841,Rl=35842,Cl=35843,Il=36196,Pl=37492,Ll=37496,Nl=37488,Dl=37489,co=37490,Ul=37491,Ol=37808,Fl=37809,kl=37810,Bl=37811,zl=37812,Gl=37813,Vl=37814,Hl=37815,Wl=37816,Xl=37817,ql=37818,$l=37819,Yl=37820,Zl=37821,Jl=36492,jl=36494,Kl=36495,Ql=36283,tc=36284,ho=36285,ec=36286;var yr=2300,ka=2301,Ta=2302,Dh=2303,Uh=2400,Oh=2401,Fh=2402;var _p=3200;var uo=0,vp=1,an="",Ze="srgb",br="srgb-linear",Mr="linear",le="srgb";var Ra=7680;var yp=519,bp=512,Mp=513,Sp=514,pu=515,wp=516,Ep=517,mu=518,gu=519,xu=35044;var _u="300 es",pi=2e3,Ss=2001;function F0(s){for(let t=s.length-1;t>=0;--t)if(s[t]>=65535)return!0;return!1}function k0(s){return ArrayBuffer.isView(s)&&!(s instanceof DataView)}function Sr(s){return document.createElementNS("http://www.w3.org/1999/xhtml",s)}function Ap(){let s=Sr("canvas");return s.style.display="block",s}var hf={},ws=null;function wr(...s){let t="THREE."+s.shift();ws?ws("log",t,...s):console.log(t,...s)}function Tp(s){let t=s[0];if(typeof t=="string"&&t.startsWith("TSL:")){let e=s[1];e&&e.isStackTrace?s[0]+=" "+e.getLocation():s[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return s}function kt(...s){s=Tp(s);let t="THREE."+s.shift();if(ws)ws("warn",t,...s);else{let e=s[0];e&&e.isStackTrace?console.warn(e.getError(t)):console.warn(t,...s)}}function Bt(...s){s=Tp(s);let t="THREE."+s.shift();if(ws)ws("error",t,...s);else{let e=s[0];e&&e.isStackTrace?console.error(e.getError(t)):console.error(t,...s)}}function xr(...s){let t=s.join(" ");t in hf||(hf[t]=!0,kt(...s))}function Rp(s,t,e){return new Promise(function(i,n){function r(){switch(s.clientWaitSync(t,s.SYNC_FLUSH_COMMANDS_BIT,0)){case s.WAIT_FAILED:n();break;case s.TIMEOUT_EXPIRED:setTimeout(r,e);break;default:i()}}setTimeout(r,e)})}var Cp={[Ca]:Ca,[Pa]:Da,[La]:La,[Ms]:Na,[Ia]:Ia,[Da]:Pa,[Ua]:Ua,[Na]:Ms},Oi=class{addEventListener(t,e){this._listeners===void 0&&(this._listeners={});let i=this._listeners;i[t]===void 0&&(i[t]=[]),i[t].indexOf(e)===-1&&i[t].push(e)}hasEventListener(t,e){let i=this._listeners;return i===void 0?!1:i[t]!==void 0&&i[t].indexOf(e)!==-1}removeEventListener(t,e){let i=this._listeners;if(i===void 0)return;let n=i[t];if(n!==void 0){let r=n.indexOf(e);r!==-1&&n.splice(r,1)}}dispatchEvent(t){let e=this._listeners;if(e===void 0)return;let i=e[t.type];if(i!==void 0){t.target=this;let n=i.slice(0);for(let r=0,o=n.length;r<o;r++)n[r].call(this,t);t.target=null}}},He=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"];var lh=Math.PI/180,Ba=180/Math.PI;function In(){let s=Math.random()*4294967295|0,t=Math.random()*4294967295|0,e=Math.random()*4294967295|0,i=Math.random()*4294967295|0;return(He[s&255]+He[s>>8&255]+He[s>>16&255]+He[s>>24&255]+"-"+He[t&255]+He[t>>8&255]+"-"+He[t>>16&15|64]+He[t>>24&255]+"-"+He[e&63|128]+He[e>>8&255]+"-"+He[e>>16&255]+He[e>>24&255]+He[i&255]+He[i>>8&255]+He[i>>16&255]+He[i>>24&255]).toLowerCase()}function Qt(s,t,e){return Math.max(t,Math.min(e,s))}function B0(s,t){return(s%t+t)%t}function ch(s,t,e){return(1-e)*s+e*t}function Ip(s){return Math.pow(2,Math.floor(Math.log(s)/Math.LN2))}function ic(s){switch(s.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function Pp(s,t){if(t.constructor===Float32Array)return s;let e=ic(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(s/e,-1)}function Lp(s,t){if(t.constructor===Float32Array)return s;let e=ic(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(s*e)}var wu=class wu{constructor(t=0,e=0){this.x=t,this.y=e}get width(){return this.x}set width(t){this.x=t}get height(){return this.y}set height(t){this.y=t}set(t,e){return this.x=t,this.y=e,this}setScalar(t){return this.x=t,this.y=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;default:throw new Error("THREE.Vector2: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y)}copy(t){return this.x=t.x,this.y=t.y,this}add(t){return this.x+=t.x,this.y+=t.y,this}addScalar(t){return this.x+=t,this.y+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this}subScalar(t){return this.x-=t,this.y-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this}multiply(t){return this.x*=t.x,this.y*=t.y,this}multiplyScalar(t){return this.x*=t,this.y*=t,this}divide(t){return this.x/=t.x,this.y/=t.y,this}divideScalar(t){return this.multiplyScalar(1/t)}applyMatrix3(t){let e=this.x,i=this.y,n=t.elements;return this.x=n[0]*e+n[3]*i+n[6],this.y=n[1]*e+n[4]*i+n[7],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this}clamp(t,e){return this.x=Qt(this.x,t.x,e.x),this.y=Qt(this.y,t.y,e.y),this}clampScalar(t,e){return this.x=Qt(this.x,t,e),this.y=Qt(this.y,t,e),this}clampLength(t,e){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Qt(i,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(t){return this.x*t.x+this.y*t.y}cross(t){return this.x*t.y-this.y*t.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let i=this.dot(t)/e;return Math.acos(Qt(i,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,i=this.y-t.y;return e*e+i*i}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this}lerpVectors(t,e,i){return this.x=t.x+(e.x-t.x)*i,this.y=t.y+(e.y-t.y)*i,this}equals(t){return t.x===this.x&&t.y===this.y}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this}rotateAround(t,e){let i=Math.cos(e),n=Math.sin(e),r=this.x-t.x,o=this.y-t.y;return this.x=r*i-o*n+t.x,this.y=r*n+o*i+t.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}};wu.prototype.isVector2=!0;var lt=wu,Fi=class{constructor(t=0,e=0,i=0,n=1){this.isQuaternion=!0,this._x=t,this._y=e,this._z=i,this._w=n}static slerpFlat(t,e,i,n,r,o,a){let l=i[n+0],c=i[n+1],h=i[n+2],u=i[n+3],d=r[o+0],f=r[o+1],p=r[o+2],_=r[o+3];if(u!==_||l!==d||c!==f||h!==p){let m=l*d+c*f+h*p+u*_;m<0&&(d=-d,f=-f,p=-p,_=-_,m=-m);let g=1-a;if(m<.9995){let b=Math.acos(m),E=Math.sin(b);g=Math.sin(g*b)/E,a=Math.sin(a*b)/E,l=l*g+d*a,c=c*g+f*a,h=h*g+p*a,u=u*g+_*a}else{l=l*g+d*a,c=c*g+f*a,h=h*g+p*a,u=u*g+_*a;let b=1/Math.sqrt(l*l+c*c+h*h+u*u);l*=b,c*=b,h*=b,u*=b}}t[e]=l,t[e+1]=c,t[e+2]=h,t[e+3]=u}static multiplyQuaternionsFlat(t,e,i,n,r,o){let a=i[n],l=i[n+1],c=i[n+2],h=i[n+3],u=r[o],d=r[o+1],f=r[o+2],p=r[o+3];return t[e]=a*p+h*u+l*f-c*d,t[e+1]=l*p+h*d+c*u-a*f,t[e+2]=c*p+h*f+a*d-l*u,t[e+3]=h*p-a*u-l*d-c*f,t}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get w(){return this._w}set w(t){this._w=t,this._onChangeCallback()}set(t,e,i,n){return this._x=t,this._y=e,this._z=i,this._w=n,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(t){return this._x=t.x,this._y=t.y,this._z=t.z,this._w=t.w,this._onChangeCallback(),this}setFromEuler(t,e=!0){let i=t._x,n=t._y,r=t._z,o=t._order,a=Math.cos,l=Math.sin,c=a(i/2),h=a(n/2),u=a(r/2),d=l(i/2),f=l(n/2),p=l(r/2);switch(o){case"XYZ":this._x=d*h*u+c*f*p,this._y=c*f*u-d*h*p,this._z=c*h*p+d*f*u,this._w=c*h*u-d*f*p;break;case"YXZ":this._x=d*h*u+c*f*p,this._y=c*f*u-d*h*p,this._z=c*h*p-d*f*u,this._w=c*h*u+d*f*p;break;case"ZXY":this._x=d*h*u-c*f*p,this._y=c*f*u+d*h*p,this._z=c*h*p+d*f*u,this._w=c*h*u-d*f*p;break;case"ZYX":this._x=d*h*u-c*f*p,this._y=c*f*u+d*h*p,this._z=c*h*p-d*f*u,this._w=c*h*u+d*f*p;break;case"YZX":this._x=d*h*u+c*f*p,this._y=c*f*u+d*h*p,this._z=c*h*p-d*f*u,this._w=c*h*u-d*f*p;break;case"XZY":this._x=d*h*u-c*f*p,this._y=c*f*u-d*h*p,this._z=c*h*p+d*f*u,this._w=c*h*u+d*f*p;break;default:kt("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return e===!0&&this._onChangeCallback(),this}setFromAxisAngle(t,e){let i=e/2,n=Math.sin(i);return this._x=t.x*n,this._y=t.y*n,this._z=t.z*n,this._w=Math.cos(i),this._onChangeCallback(),this}setFromRotationMatrix(t){let e=t.elements,i=e[0],n=e[4],r=e[8],o=e[1],a=e[5],l=e[9],c=e[2],h=e[6],u=e[10],d=i+a+u;if(d>0){let f=.5/Math.sqrt(d+1);this._w=.25/f,this._x=(h-l)*f,this._y=(r-c)*f,this._z=(o-n)*f}else if(i>a&&i>u){let f=2*Math.sqrt(1+i-a-u);this._w=(h-l)/f,this._x=.25*f,this._y=(n+o)/f,this._z=(r+c)/f}else if(a>u){let f=2*Math.sqrt(1+a-i-u);this._w=(r-c)/f,this._x=(n+o)/f,this._y=.25*f,this._z=(l+h)/f}else{let f=2*Math.sqrt(1+u-i-a);this._w=(o-n)/f,this._x=(r+c)/f,this._y=(l+h)/f,this._z=.25*f}return this._onChangeCallback(),this}setFromUnitVectors(t,e){let i=t.dot(e)+1;return i<1e-8?(i=0,Math.abs(t.x)>Math.abs(t.z)?(this._x=-t.y,this._y=t.x,this._z=0,this._w=i):(this._x=0,this._y=-t.z,this._z=t.y,this._w=i)):(this._x=t.y*e.z-t.z*e.y,this._y=t.z*e.x-t.x*e.z,this._z=t.x*e.y-t.y*e.x,this._w=i),this.normalize()}angleTo(t){return 2*Math.acos(Math.abs(Qt(this.dot(t),-1,1)))}rotateTowards(t,e){let i=this.angleTo(t);if(i===0)return this;let n=Math.min(1,e/i);return this.slerp(t,n),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(t){return this._x*t._x+this._y*t._y+this._z*t._z+this._w*t._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let t=this.length();return t===0?(this._x=0,this._y=0,this._z=0,this._w=1):(t=1/t,this._x=this._x*t,this._y=this._y*t,this._z=this._z*t,this._w=this._w*t),this._onChangeCallback(),this}multiply(t){return this.multiplyQuaternions(this,t)}premultiply(t){return this.multiplyQuaternions(t,this)}multiplyQuaternions(t,e){let i=t._x,n=t._y,r=t._z,o=t._w,a=e._x,l=e._y,c=e._z,h=e._w;return this._x=i*h+o*a+n*c-r*l,this._y=n*h+o*l+r*a-i*c,this._z=r*h+o*c+i*l-n*a,this._w=o*h-i*a-n*l-r*c,this._onChangeCallback(),this}slerp(t,e){let i=t._x,n=t._y,r=t._z,o=t._w,a=this.dot(t);a<0&&(i=-i,n=-n,r=-r,o=-o,a=-a);let l=1-e;if(a<.9995){let c=Math.acos(a),h=Math.sin(c);l=Math.sin(l*c)/h,e=Math.sin(e*c)/h,this._x=this._x*l+i*e,this._y=this._y*l+n*e,this._z=this._z*l+r*e,this._w=this._w*l+o*e,this._onChangeCallback()}else this._x=this._x*l+i*e,this._y=this._y*l+n*e,this._z=this._z*l+r*e,this._w=this._w*l+o*e,this.normalize();return this}slerpQuaternions(t,e,i){return this.copy(t).slerp(e,i)}random(){let t=2*Math.PI*Math.random(),e=2*Math.PI*Math.random(),i=Math.random(),n=Math.sqrt(1-i),r=Math.sqrt(i);return this.set(n*Math.sin(t),n*Math.cos(t),r*Math.sin(e),r*Math.cos(e))}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._w===this._w}fromArray(t,e=0){return this._x=t[e],this._y=t[e+1],this._z=t[e+2],this._w=t[e+3],this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._w,t}fromBufferAttribute(t,e){return this._x=t.getX(e),this._y=t.getY(e),this._z=t.getZ(e),this._w=t.getW(e),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},Eu=class Eu{constructor(t=0,e=0,i=0){this.x=t,this.y=e,this.z=i}set(t,e,i){return i===void 0&&(i=this.z),this.x=t,this.y=e,this.z=i,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;default:throw new Error("THREE.Vector3: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this}multiplyVectors(t,e){return this.x=t.x*e.x,this.y=t.y*e.y,this.z=t.z*e.z,this}applyEuler(t){return this.applyQuaternion(uf.setFromEuler(t))}applyAxisAngle(t,e){return this.applyQuaternion(uf.setFromAxisAngle(t,e))}applyMatrix3(t){let e=this.x,i=this.y,n=this.z,r=t.elements;return this.x=r[0]*e+r[3]*i+r[6]*n,this.y=r[1]*e+r[4]*i+r[7]*n,this.z=r[2]*e+r[5]*i+r[8]*n,this}applyNormalMatrix(t){return this.applyMatrix3(t).normalize()}applyMatrix4(t){let e=this.x,i=this.y,n=this.z,r=t.elements,o=1/(r[3]*e+r[7]*i+r[11]*n+r[15]);return this.x=(r[0]*e+r[4]*i+r[8]*n+r[12])*o,this.y=(r[1]*e+r[5]*i+r[9]*n+r[13])*o,this.z=(r[2]*e+r[6]*i+r[10]*n+r[14])*o,this}applyQuaternion(t){let e=this.x,i=this.y,n=this.z,r=t.x,o=t.y,a=t.z,l=t.w,c=2*(o*n-a*i),h=2*(a*e-r*n),u=2*(r*i-o*e);return this.x=e+l*c+o*u-a*h,this.y=i+l*h+a*c-r*u,this.z=n+l*u+r*h-o*c,this}project(t){return this.applyMatrix4(t.matrixWorldInverse).applyMatrix4(t.projectionMatrix)}unproject(t){return this.applyMatrix4(t.projectionMatrixInverse).applyMatrix4(t.matrixWorld)}transformDirection(t){let e=this.x,i=this.y,n=this.z,r=t.elements;return this.x=r[0]*e+r[4]*i+r[8]*n,this.y=r[1]*e+r[5]*i+r[9]*n,this.z=r[2]*e+r[6]*i+r[10]*n,this.normalize()}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this}divideScalar(t){return this.multiplyScalar(1/t)}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this}clamp(t,e){return this.x=Qt(this.x,t.x,e.x),this.y=Qt(this.y,t.y,e.y),this.z=Qt(this.z,t.z,e.z),this}clampScalar(t,e){return this.x=Qt(this.x,t,e),this.y=Qt(this.y,t,e),this.z=Qt(this.z,t,e),this}clampLength(t,e){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Qt(i,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this}lerpVectors(t,e,i){return this.x=t.x+(e.x-t.x)*i,this.y=t.y+(e.y-t.y)*i,this.z=t.z+(e.z-t.z)*i,this}cross(t){return this.crossVectors(this,t)}crossVectors(t,e){let i=t.x,n=t.y,r=t.z,o=e.x,a=e.y,l=e.z;return this.x=n*l-r*a,this.y=r*o-i*l,this.z=i*a-n*o,this}projectOnVector(t){let e=t.lengthSq();if(e===0)return this.set(0,0,0);let i=t.dot(this)/e;return this.copy(t).multiplyScalar(i)}projectOnPlane(t){return hh.copy(this).projectOnVector(t),this.sub(hh)}reflect(t){return this.sub(hh.copy(t).multiplyScalar(2*this.dot(t)))}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let i=this.dot(t)/e;return Math.acos(Qt(i,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,i=this.y-t.y,n=this.z-t.z;return e*e+i*i+n*n}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)+Math.abs(this.z-t.z)}setFromSpherical(t){return this.setFromSphericalCoords(t.radius,t.phi,t.theta)}setFromSphericalCoords(t,e,i){let n=Math.sin(e)*t;return this.x=n*Math.sin(i),this.y=Math.cos(e)*t,this.z=n*Math.cos(i),this}setFromCylindrical(t){return this.setFromCylindricalCoords(t.radius,t.theta,t.y)}setFromCylindricalCoords(t,e,i){return this.x=t*Math.sin(e),this.y=i,this.z=t*Math.cos(e),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this}setFromMatrixScale(t){let e=this.setFromMatrixColumn(t,0).length(),i=this.setFromMatrixColumn(t,1).length(),n=this.setFromMatrixColumn(t,2).length();return this.x=e,this.y=i,this.z=n,this}setFromMatrixColumn(t,e){return this.fromArray(t.elements,e*4)}setFromMatrix3Column(t,e){return this.fromArray(t.elements,e*3)}setFromEuler(t){return this.x=t._x,this.y=t._y,this.z=t._z,this}setFromColor(t){return this.x=t.r,this.y=t.g,this.z=t.b,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let t=Math.random()*Math.PI*2,e=Math.random()*2-1,i=Math.sqrt(1-e*e);return this.x=i*Math.cos(t),this.y=e,this.z=i*Math.sin(t),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}};Eu.prototype.isVector3=!0;var L=Eu,hh=new L,uf=new Fi,Au=class Au{constructor(t,e,i,n,r,o,a,l,c){this.elements=[1,0,0,0,1,0,0,0,1],t!==void 0&&this.set(t,e,i,n,r,o,a,l,c)}set(t,e,i,n,r,o,a,l,c){let h=this.elements;return h[0]=t,h[1]=n,h[2]=a,h[3]=e,h[4]=r,h[5]=l,h[6]=i,h[7]=o,h[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(t){let e=this.elements,i=t.elements;return e[0]=i[0],e[1]=i[1],e[2]=i[2],e[3]=i[3],e[4]=i[4],e[5]=i[5],e[6]=i[6],e[7]=i[7],e[8]=i[8],this}extractBasis(t,e,i){return t.setFromMatrix3Column(this,0),e.setFromMatrix3Column(this,1),i.setFromMatrix3Column(this,2),this}setFromMatrix4(t){let e=t.elements;return this.set(e[0],e[4],e[8],e[1],e[5],e[9],e[2],e[6],e[10]),this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let i=t.elements,n=e.elements,r=this.elements,o=i[0],a=i[3],l=i[6],c=i[1],h=i[4],u=i[7],d=i[2],f=i[5],p=i[8],_=n[0],m=n[3],g=n[6],b=n[1],E=n[4],M=n[7],T=n[2],A=n[5],x=n[8];return r[0]=o*_+a*b+l*T,r[3]=o*m+a*E+l*A,r[6]=o*g+a*M+l*x,r[1]=c*_+h*b+u*T,r[4]=c*m+h*E+u*A,r[7]=c*g+h*M+u*x,r[2]=d*_+f*b+p*T,r[5]=d*m+f*E+p*A,r[8]=d*g+f*M+p*x,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[3]*=t,e[6]*=t,e[1]*=t,e[4]*=t,e[7]*=t,e[2]*=t,e[5]*=t,e[8]*=t,this}determinant(){let t=this.elements,e=t[0],i=t[1],n=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8];return e*o*h-e*a*c-i*r*h+i*a*l+n*r*c-n*o*l}invert(){let t=this.elements,e=t[0],i=t[1],n=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8],u=h*o-a*c,d=a*l-h*r,f=c*r-o*l,p=e*u+i*d+n*f;if(p===0)return this.set(0,0,0,0,0,0,0,0,0);let _=1/p;return t[0]=u*_,t[1]=(n*c-h*i)*_,t[2]=(a*i-n*o)*_,t[3]=d*_,t[4]=(h*e-n*l)*_,t[5]=(n*r-a*e)*_,t[6]=f*_,t[7]=(i*l-c*e)*_,t[8]=(o*e-i*r)*_,this}transpose(){let t,e=this.elements;return t=e[1],e[1]=e[3],e[3]=t,t=e[2],e[2]=e[6],e[6]=t,t=e[5],e[5]=e[7],e[7]=t,this}getNormalMatrix(t){return this.setFromMatrix4(t).invert().transpose()}transposeIntoArray(t){let e=this.elements;return t[0]=e[0],t[1]=e[3],t[2]=e[6],t[3]=e[1],t[4]=e[4],t[5]=e[7],t[6]=e[2],t[7]=e[5],t[8]=e[8],this}setUvTransform(t,e,i,n,r,o,a){let l=Math.cos(r),c=Math.sin(r);return this.set(i*l,i*c,-i*(l*o+c*a)+o+t,-n*c,n*l,-n*(-c*o+l*a)+a+e,0,0,1),this}scale(t,e){return xr("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(uh.makeScale(t,e)),this}rotate(t){return xr("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(uh.makeRotation(-t)),this}translate(t,e){return xr("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(uh.makeTranslation(t,e)),this}makeTranslation(t,e){return t.isVector2?this.set(1,0,t.x,0,1,t.y,0,0,1):this.set(1,0,t,0,1,e,0,0,1),this}makeRotation(t){let e=Math.cos(t),i=Math.sin(t);return this.set(e,-i,0,i,e,0,0,0,1),this}makeScale(t,e){return this.set(t,0,0,0,e,0,0,0,1),this}equals(t){let e=this.elements,i=t.elements;for(let n=0;n<9;n++)if(e[n]!==i[n])return!1;return!0}fromArray(t,e=0){for(let i=0;i<9;i++)this.elements[i]=t[i+e];return this}toArray(t=[],e=0){let i=this.elements;return t[e]=i[0],t[e+1]=i[1],t[e+2]=i[2],t[e+3]=i[3],t[e+4]=i[4],t[e+5]=i[5],t[e+6]=i[6],t[e+7]=i[7],t[e+8]=i[8],t}clone(){return new this.constructor().fromArray(this.elements)}};Au.prototype.isMatrix3=!0;var Gt=Au,uh=new Gt,df=new Gt().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),ff=new Gt().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function z0(){let s={enabled:!0,workingColorSpace:br,spaces:{},convert:function(n,r,o){return this.enabled===!1||r===o||!r||!o||(this.spaces[r].transfer===le&&(n.r=tn(n.r),n.g=tn(n.g),n.b=tn(n.b)),this.spaces[r].primaries!==this.spaces[o].primaries&&(n.applyMatrix3(this.spaces[r].toXYZ),n.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===le&&(n.r=bs(n.r),n.g=bs(n.g),n.b=bs(n.b))),n},workingToColorSpace:function(n,r){return this.convert(n,this.workingColorSpace,r)},colorSpaceToWorking:function(n,r){return this.convert(n,r,this.workingColorSpace)},getPrimaries:function(n){return this.spaces[n].primaries},getTransfer:function(n){return n===an?Mr:this.spaces[n].transfer},getToneMappingMode:function(n){return this.spaces[n].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(n,r=this.workingColorSpace){return n.fromArray(this.spaces[r].luminanceCoefficients)},define:function(n){Object.assign(this.spaces,n)},_getMatrix:function(n,r,o){return n.copy(this.spaces[o].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(n){return this.spaces[n].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(n=this.workingColorSpace){return this.spaces[n].workingColorSpaceConfig.unpackColorSpace}},t=[.64,.33,.3,.6,.15,.06],e=[.2126,.7152,.0722],i=[.3127,.329];return s.define({[br]:{primaries:t,whitePoint:i,transfer:Mr,toXYZ:df,fromXYZ:ff,luminanceCoefficients:e,workingColorSpaceConfig:{unpackColorSpace:Ze},outputColorSpaceConfig:{drawingBufferColorSpace:Ze}},[Ze]:{primaries:t,whitePoint:i,transfer:le,toXYZ:df,fromXYZ:ff,luminanceCoefficients:e,outputColorSpaceConfig:{drawingBufferColorSpace:Ze}}}),s}var ne=z0();function tn(s){return s<.04045?s*.0773993808:Math.pow(s*.9478672986+.0521327014,2.4)}function bs(s){return s<.0031308?s*12.92:1.055*Math.pow(s,.41666)-.055}var as,za=class{static getDataURL(t,e="image/png"){if(/^data:/i.test(t.src)||typeof HTMLCanvasElement>"u")return t.src;let i;if(t instanceof HTMLCanvasElement)i=t;else{as===void 0&&(as=Sr("canvas")),as.width=t.width,as.height=t.height;let n=as.getContext("2d");t instanceof ImageData?n.putImageData(t,0,0):n.drawImage(t,0,0,t.width,t.height),i=as}return i.toDataURL(e)}static sRGBToLinear(t){if(typeof HTMLImageElement<"u"&&t instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&t instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&t instanceof ImageBitmap){let e=Sr("canvas");e.width=t.width,e.height=t.height;let i=e.getContext("2d");i.drawImage(t,0,0,t.width,t.height);let n=i.getImageData(0,0,t.width,t.height),r=n.data;for(let o=0;o<r.length;o++)r[o]=tn(r[o]/255)*255;return i.putImageData(n,0,0),e}else if(t.data){let e=t.data.slice(0);for(let i=0;i<e.length;i++)e instanceof Uint8Array||e instanceof Uint8ClampedArray?e[i]=Math.floor(tn(e[i]/255)*255):e[i]=tn(e[i]);return{data:e,width:t.width,height:t.height}}else return kt("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),t}},G0=0,Es=class{constructor(t=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:G0++}),this.uuid=In(),this.data=t,this.dataReady=!0,this.version=0}getSize(t){let e=this.data;return typeof HTMLVideoElement<"u"&&e instanceof HTMLVideoElement?t.set(e.videoWidth,e.videoHeight,0):typeof VideoFrame<"u"&&e instanceof VideoFrame?t.set(e.displayWidth,e.displayHeight,0):e!==null?t.set(e.width||0,e.height||0,e.depth||0):t.set(0,0,0),t}set needsUpdate(t){t===!0&&this.version++}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.images[this.uuid]!==void 0)return t.images[this.uuid];let i={uuid:this.uuid,url:""},n=this.data;if(n!==null){let r;if(Array.isArray(n)){r=[];for(let o=0,a=n.length;o<a;o++)n[o].isDataTexture?r.push(dh(n[o].image)):r.push(dh(n[o]))}else r=dh(n);i.url=r}return e||(t.images[this.uuid]=i),i}};function dh(s){return typeof HTMLImageElement<"u"&&s instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&s instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&s instanceof ImageBitmap?za.getDataURL(s):s.data?{data:Array.from(s.data),width:s.width,height:s.height,type:s.data.constructor.name}:(kt("Texture: Unable to serialize Texture."),{})}var V0=0,fh=new L,ei=class s extends Oi{constructor(t=s.DEFAULT_IMAGE,e=s.DEFAULT_MAPPING,i=Ui,n=Ui,r=Je,o=rn,a=Ci,l=ii,c=s.DEFAULT_ANISOTROPY,h=an){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:V0++}),this.uuid=In(),this.name="",this.source=new Es(t),this.mipmaps=[],this.mapping=e,this.channel=0,this.wrapS=i,this.wrapT=n,this.magFilter=r,this.minFilter=o,this.anisotropy=c,this.format=a,this.internalFormat=null,this.type=l,this.offset=new lt(0,0),this.repeat=new lt(1,1),this.center=new lt(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new Gt,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(t&&t.depth&&t.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(fh).x}get height(){return this.source.getSize(fh).y}get depth(){return this.source.getSize(fh).z}get image(){return this.source.data}set image(t){this.source.data=t}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(t){return this.name=t.name,this.source=t.source,this.mipmaps=t.mipmaps.slice(0),this.mapping=t.mapping,this.channel=t.channel,this.wrapS=t.wrapS,this.wrapT=t.wrapT,this.magFilter=t.magFilter,this.minFilter=t.minFilter,this.anisotropy=t.anisotropy,this.format=t.format,this.internalFormat=t.internalFormat,this.type=t.type,this.normalized=t.normalized,this.offset.copy(t.offset),this.repeat.copy(t.repeat),this.center.copy(t.center),this.rotation=t.rotation,this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrix.copy(t.matrix),this.generateMipmaps=t.generateMipmaps,this.mipmapsAutoUpdate=t.mipmapsAutoUpdate,this.premultiplyAlpha=t.premultiplyAlpha,this.flipY=t.flipY,this.unpackAlignment=t.unpackAlignment,this.colorSpace=t.colorSpace,this.renderTarget=t.renderTarget,this.isRenderTargetTexture=t.isRenderTargetTexture,this.isPMREMTexture=t.isPMREMTexture,this.isArrayTexture=t.isArrayTexture,this.userData=JSON.parse(JSON.stringify(t.userData)),this.needsUpdate=!0,this}setValues(t){for(let e in t){let i=t[e];if(i===void 0){kt(`Texture.setValues(): parameter '${e}' has value of undefined.`);continue}let n=this[e];if(n===void 0){kt(`Texture.setValues(): property '${e}' does not exist.`);continue}n&&i&&n.isVector2&&i.isVector2||n&&i&&n.isVector3&&i.isVector3||n&&i&&n.isMatrix3&&i.isMatrix3?n.copy(i):this[e]=i}}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.textures[this.uuid]!==void 0)return t.textures[this.uuid];let i={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(t).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(i.userData=this.userData),e||(t.textures[this.uuid]=i),i}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(t){if(this.mapping!==au)return t;if(t.applyMatrix3(this.matrix),t.x<0||t.x>1)switch(this.wrapS){case Oa:t.x=t.x-Math.floor(t.x);break;case Ui:t.x=t.x<0?0:1;break;case Fa:Math.abs(Math.floor(t.x)%2)===1?t.x=Math.ceil(t.x)-t.x:t.x=t.x-Math.floor(t.x);break}if(t.y<0||t.y>1)switch(this.wrapT){case Oa:t.y=t.y-Math.floor(t.y);break;case Ui:t.y=t.y<0?0:1;break;case Fa:Math.abs(Math.floor(t.y)%2)===1?t.y=Math.ceil(t.y)-t.y:t.y=t.y-Math.floor(t.y);break}return this.flipY&&(t.y=1-t.y),t}set needsUpdate(t){t===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(t){t===!0&&this.pmremVersion++}};ei.DEFAULT_IMAGE=null;ei.DEFAULT_MAPPING=au;ei.DEFAULT_ANISOTROPY=1;var Tu=class Tu{constructor(t=0,e=0,i=0,n=1){this.x=t,this.y=e,this.z=i,this.w=n}get width(){return this.z}set width(t){this.z=t}get height(){return this.w}set height(t){this.w=t}set(t,e,i,n){return this.x=t,this.y=e,this.z=i,this.w=n,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this.w=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setW(t){return this.w=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;case 3:this.w=e;break;default:throw new Error("THREE.Vector4: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this.w=t.w!==void 0?t.w:1,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this.w+=t.w,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this.w+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this.w=t.w+e.w,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this.w+=t.w*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this.w-=t.w,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this.w-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this.w=t.w-e.w,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this.w*=t.w,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this.w*=t,this}applyMatrix4(t){let e=this.x,i=this.y,n=this.z,r=this.w,o=t.elements;return this.x=o[0]*e+o[4]*i+o[8]*n+o[12]*r,this.y=o[1]*e+o[5]*i+o[9]*n+o[13]*r,this.z=o[2]*e+o[6]*i+o[10]*n+o[14]*r,this.w=o[3]*e+o[7]*i+o[11]*n+o[15]*r,this}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this.w/=t.w,this}divideScalar(t){return this.multiplyScalar(1/t)}setAxisAngleFromQuaternion(t){this.w=2*Math.acos(t.w);let e=Math.sqrt(1-t.w*t.w);return e<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=t.x/e,this.y=t.y/e,this.z=t.z/e),this}setAxisAngleFromRotationMatrix(t){let e,i,n,r,l=t.elements,c=l[0],h=l[4],u=l[8],d=l[1],f=l[5],p=l[9],_=l[2],m=l[6],g=l[10];if(Math.abs(h-d)<.01&&Math.abs(u-_)<.01&&Math.abs(p-m)<.01){if(Math.abs(h+d)<.1&&Math.abs(u+_)<.1&&Math.abs(p+m)<.1&&Math.abs(c+f+g-3)<.1)return this.set(1,0,0,0),this;e=Math.PI;let E=(c+1)/2,M=(f+1)/2,T=(g+1)/2,A=(h+d)/4,x=(u+_)/4,S=(p+m)/4;return E>M&&E>T?E<.01?(i=0,n=.707106781,r=.707106781):(i=Math.sqrt(E),n=A/i,r=x/i):M>T?M<.01?(i=.707106781,n=0,r=.707106781):(n=Math.sqrt(M),i=A/n,r=S/n):T<.01?(i=.707106781,n=.707106781,r=0):(r=Math.sqrt(T),i=x/r,n=S/r),this.set(i,n,r,e),this}let b=Math.sqrt((m-p)*(m-p)+(u-_)*(u-_)+(d-h)*(d-h));return Math.abs(b)<.001&&(b=1),this.x=(m-p)/b,this.y=(u-_)/b,this.z=(d-h)/b,this.w=Math.acos((c+f+g-1)/2),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this.w=e[15],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this.w=Math.min(this.w,t.w),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this.w=Math.max(this.w,t.w),this}clamp(t,e){return this.x=Qt(this.x,t.x,e.x),this.y=Qt(this.y,t.y,e.y),this.z=Qt(this.z,t.z,e.z),this.w=Qt(this.w,t.w,e.w),this}clampScalar(t,e){return this.x=Qt(this.x,t,e),this.y=Qt(this.y,t,e),this.z=Qt(this.z,t,e),this.w=Qt(this.w,t,e),this}clampLength(t,e){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Qt(i,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z+this.w*t.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this.w+=(t.w-this.w)*e,this}lerpVectors(t,e,i){return this.x=t.x+(e.x-t.x)*i,this.y=t.y+(e.y-t.y)*i,this.z=t.z+(e.z-t.z)*i,this.w=t.w+(e.w-t.w)*i,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z&&t.w===this.w}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this.w=t[e+3],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t[e+3]=this.w,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this.w=t.getW(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}};Tu.prototype.isVector4=!0;var fe=Tu,Ga=class extends Oi{constructor(t=1,e=1,i={}){super(),i=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:Je,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},i),this.isRenderTarget=!0,this.width=t,this.height=e,this.depth=i.depth,this.scissor=new fe(0,0,t,e),this.scissorTest=!1,this.viewport=new fe(0,0,t,e),this.textures=[];let n=i.count;for(let r=0;r<n;r++)this.textures[r]=new ei({width:t,height:e,depth:i.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(i),this.depthBuffer=i.depthBuffer,this.stencilBuffer=i.stencilBuffer,this.resolveColorBuffer=i.resolveColorBuffer,this.resolveDepthBuffer=i.resolveDepthBuffer,this.resolveStencilBuffer=i.resolveStencilBuffer,this.storeMultisampledColorBuffer=i.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=i.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=i.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=i.depthTexture,this.samples=i.samples,this.multiview=i.multiview,this.useArrayDepthTexture=i.useArrayDepthTexture}_setTextureOptions(t={}){let e={minFilter:Je,generateMipmaps:!1,flipY:!1,internalFormat:null};t.mapping!==void 0&&(e.mapping=t.mapping),t.wrapS!==void 0&&(e.wrapS=t.wrapS),t.wrapT!==void 0&&(e.wrapT=t.wrapT),t.wrapR!==void 0&&(e.wrapR=t.wrapR),t.magFilter!==void 0&&(e.magFilter=t.magFilter),t.minFilter!==void 0&&(e.minFilter=t.minFilter),t.format!==void 0&&(e.format=t.format),t.type!==void 0&&(e.type=t.type),t.anisotropy!==void 0&&(e.anisotropy=t.anisotropy),t.colorSpace!==void 0&&(e.colorSpace=t.colorSpace),t.flipY!==void 0&&(e.flipY=t.flipY),t.generateMipmaps!==void 0&&(e.generateMipmaps=t.generateMipmaps),t.mipmapsAutoUpdate!==void 0&&(e.mipmapsAutoUpdate=t.mipmapsAutoUpdate),t.internalFormat!==void 0&&(e.internalFormat=t.internalFormat);for(let i=0;i<this.textures.length;i++)this.textures[i].setValues(e)}get texture(){return this.textures[0]}set texture(t){this.textures[0]=t}set depthTexture(t){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),t!==null&&t.renderTarget===null&&(t.renderTarget=this),this._depthTexture=t}get depthTexture(){return this._depthTexture}setSize(t,e,i=1){if(this.width!==t||this.height!==e||this.depth!==i){this.width=t,this.height=e,this.depth=i;for(let n=0,r=this.textures.length;n<r;n++)this.textures[n].image.width=t,this.textures[n].image.height=e,this.textures[n].image.depth=i,this.textures[n].isData3DTexture!==!0&&(this.textures[n].isArrayTexture=this.textures[n].image.depth>1);this.dispose()}this.viewport.set(0,0,t,e),this.scissor.set(0,0,t,e)}clone(){return new this.constructor().copy(this)}copy(t){this.width=t.width,this.height=t.height,this.depth=t.depth,this.scissor.copy(t.scissor),this.scissorTest=t.scissorTest,this.viewport.copy(t.viewport),this.textures.length=0;for(let e=0,i=t.textures.length;e<i;e++){this.textures[e]=t.textures[e].clone(),this.textures[e].isRenderTargetTexture=!0,this.textures[e].renderTarget=this;let n=Object.assign({},t.textures[e].image);this.textures[e].source=new Es(n)}if(this.depthBuffer=t.depthBuffer,this.stencilBuffer=t.stencilBuffer,this.resolveColorBuffer=t.resolveColorBuffer,this.resolveDepthBuffer=t.resolveDepthBuffer,this.resolveStencilBuffer=t.resolveStencilBuffer,this.storeMultisampledColorBuffer=t.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=t.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=t.storeMultisampledStencilBuffer,t.depthTexture!==null)if(t.depthTexture.renderTarget===t){let e=t.depthTexture.clone();e.renderTarget=null,this.depthTexture=e}else this.depthTexture=t.depthTexture;else this.depthTexture=null;return this.samples=t.samples,this.multiview=t.multiview,this.useArrayDepthTexture=t.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},li=class extends Ga{constructor(t=1,e=1,i={}){super(t,e,i),this.isWebGLRenderTarget=!0}},Er=class extends ei{constructor(t=null,e=1,i=1,n=1){super(null),this.isDataArrayTexture=!0,this.image={data:t,width:e,height:i,depth:n},this.magFilter=Fe,this.minFilter=Fe,this.wrapR=Ui,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}addLayerUpdate(t){this.layerUpdates.add(t)}clearLayerUpdates(){this.layerUpdates.clear()}};var Va=class extends ei{constructor(t=null,e=1,i=1,n=1){super(null),this.isData3DTexture=!0,this.image={data:t,width:e,height:i,depth:n},this.magFilter=Fe,this.minFilter=Fe,this.wrapR=Ui,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}};var pl=class pl{constructor(t,e,i,n,r,o,a,l,c,h,u,d,f,p,_,m){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],t!==void 0&&this.set(t,e,i,n,r,o,a,l,c,h,u,d,f,p,_,m)}set(t,e,i,n,r,o,a,l,c,h,u,d,f,p,_,m){let g=this.elements;return g[0]=t,g[4]=e,g[8]=i,g[12]=n,g[1]=r,g[5]=o,g[9]=a,g[13]=l,g[2]=c,g[6]=h,g[10]=u,g[14]=d,g[3]=f,g[7]=p,g[11]=_,g[15]=m,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new pl().fromArray(this.elements)}copy(t){let e=this.elements,i=t.elements;return e[0]=i[0],e[1]=i[1],e[2]=i[2],e[3]=i[3],e[4]=i[4],e[5]=i[5],e[6]=i[6],e[7]=i[7],e[8]=i[8],e[9]=i[9],e[10]=i[10],e[11]=i[11],e[12]=i[12],e[13]=i[13],e[14]=i[14],e[15]=i[15],this}copyPosition(t){let e=this.elements,i=t.elements;return e[12]=i[12],e[13]=i[13],e[14]=i[14],this}setFromMatrix3(t){let e=t.elements;return this.set(e[0],e[3],e[6],0,e[1],e[4],e[7],0,e[2],e[5],e[8],0,0,0,0,1),this}extractBasis(t,e,i){return this.determinantAffine()===0?(t.set(1,0,0),e.set(0,1,0),i.set(0,0,1),this):(t.setFromMatrixColumn(this,0),e.setFromMatrixColumn(this,1),i.setFromMatrixColumn(this,2),this)}makeBasis(t,e,i){return this.set(t.x,e.x,i.x,0,t.y,e.y,i.y,0,t.z,e.z,i.z,0,0,0,0,1),this}extractRotation(t){if(t.determinantAffine()===0)return this.identity();let e=this.elements,i=t.elements,n=1/ls.setFromMatrixColumn(t,0).length(),r=1/ls.setFromMatrixColumn(t,1).length(),o=1/ls.setFromMatrixColumn(t,2).length();return e[0]=i[0]*n,e[1]=i[1]*n,e[2]=i[2]*n,e[3]=0,e[4]=i[4]*r,e[5]=i[5]*r,e[6]=i[6]*r,e[7]=0,e[8]=i[8]*o,e[9]=i[9]*o,e[10]=i[10]*o,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromEuler(t){let e=this.elements,i=t.x,n=t.y,r=t.z,o=Math.cos(i),a=Math.sin(i),l=Math.cos(n),c=Math.sin(n),h=Math.cos(r),u=Math.sin(r);if(t.order==="XYZ"){let d=o*h,f=o*u,p=a*h,_=a*u;e[0]=l*h,e[4]=-l*u,e[8]=c,e[1]=f+p*c,e[5]=d-_*c,e[9]=-a*l,e[2]=_-d*c,e[6]=p+f*c,e[10]=o*l}else if(t.order==="YXZ"){let d=l*h,f=l*u,p=c*h,_=c*u;e[0]=d+_*a,e[4]=p*a-f,e[8]=o*c,e[1]=o*u,e[5]=o*h,e[9]=-a,e[2]=f*a-p,e[6]=_+d*a,e[10]=o*l}else if(t.order==="ZXY"){let d=l*h,f=l*u,p=c*h,_=c*u;e[0]=d-_*a,e[4]=-o*u,e[8]=p+f*a,e[1]=f+p*a,e[5]=o*h,e[9]=_-d*a,e[2]=-o*c,e[6]=a,e[10]=o*l}else if(t.order==="ZYX"){let d=o*h,f=o*u,p=a*h,_=a*u;e[0]=l*h,e[4]=p*c-f,e[8]=d*c+_,e[1]=l*u,e[5]=_*c+d,e[9]=f*c-p,e[2]=-c,e[6]=a*l,e[10]=o*l}else if(t.order==="YZX"){let d=o*l,f=o*c,p=a*l,_=a*c;e[0]=l*h,e[4]=_-d*u,e[8]=p*u+f,e[1]=u,e[5]=o*h,e[9]=-a*h,e[2]=-c*h,e[6]=f*u+p,e[10]=d-_*u}else if(t.order==="XZY"){let d=o*l,f=o*c,p=a*l,_=a*c;e[0]=l*h,e[4]=-u,e[8]=c*h,e[1]=d*u+_,e[5]=o*h,e[9]=f*u-p,e[2]=p*u-f,e[6]=a*h,e[10]=_*u+d}return e[3]=0,e[7]=0,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromQuaternion(t){return this.compose(H0,t,W0)}lookAt(t,e,i){let n=this.elements;return oi.subVectors(t,e),oi.lengthSq()===0&&(oi.z=1),oi.normalize(),mn.crossVectors(i,oi),mn.lengthSq()===0&&(Math.abs(i.z)===1?oi.x+=1e-4:oi.z+=1e-4,oi.normalize(),mn.crossVectors(i,oi)),mn.normalize(),ta.crossVectors(oi,mn),n[0]=mn.x,n[4]=ta.x,n[8]=oi.x,n[1]=mn.y,n[5]=ta.y,n[9]=oi.y,n[2]=mn.z,n[6]=ta.z,n[10]=oi.z,this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let i=t.elements,n=e.elements,r=this.elements,o=i[0],a=i[4],l=i[8],c=i[12],h=i[1],u=i[5],d=i[9],f=i[13],p=i[2],_=i[6],m=i[10],g=i[14],b=i[3],E=i[7],M=i[11],T=i[15],A=n[0],x=n[4],S=n[8],U=n[12],I=n[1],D=n[5],F=n[9],H=n[13],C=n[2],z=n[6],X=n[10],G=n[14],et=n[3],W=n[7],K=n[11],tt=n[15];return r[0]=o*A+a*I+l*C+c*et,r[4]=o*x+a*D+l*z+c*W,r[8]=o*S+a*F+l*X+c*K,r[12]=o*U+a*H+l*G+c*tt,r[1]=h*A+u*I+d*C+f*et,r[5]=h*x+u*D+d*z+f*W,r[9]=h*S+u*F+d*X+f*K,r[13]=h*U+u*H+d*G+f*tt,r[2]=p*A+_*I+m*C+g*et,r[6]=p*x+_*D+m*z+g*W,r[10]=p*S+_*F+m*X+g*K,r[14]=p*U+_*H+m*G+g*tt,r[3]=b*A+E*I+M*C+T*et,r[7]=b*x+E*D+M*z+T*W,r[11]=b*S+E*F+M*X+T*K,r[15]=b*U+E*H+M*G+T*tt,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[4]*=t,e[8]*=t,e[12]*=t,e[1]*=t,e[5]*=t,e[9]*=t,e[13]*=t,e[2]*=t,e[6]*=t,e[10]*=t,e[14]*=t,e[3]*=t,e[7]*=t,e[11]*=t,e[15]*=t,this}determinant(){let t=this.elements,e=t[0],i=t[4],n=t[8],r=t[12],o=t[1],a=t[5],l=t[9],c=t[13],h=t[2],u=t[6],d=t[10],f=t[14],p=t[3],_=t[7],m=t[11],g=t[15],b=l*f-c*d,E=a*f-c*u,M=a*d-l*u,T=o*f-c*h,A=o*d-l*h,x=o*u-a*h;return e*(_*b-m*E+g*M)-i*(p*b-m*T+g*A)+n*(p*E-_*T+g*x)-r*(p*M-_*A+m*x)}determinantAffine(){let t=this.elements,e=t[0],i=t[4],n=t[8],r=t[1],o=t[5],a=t[9],l=t[2],c=t[6],h=t[10];return e*(o*h-a*c)-i*(r*h-a*l)+n*(r*c-o*l)}transpose(){let t=this.elements,e;return e=t[1],t[1]=t[4],t[4]=e,e=t[2],t[2]=t[8],t[8]=e,e=t[6],t[6]=t[9],t[9]=e,e=t[3],t[3]=t[12],t[12]=e,e=t[7],t[7]=t[13],t[13]=e,e=t[11],t[11]=t[14],t[14]=e,this}setPosition(t,e,i){let n=this.elements;return t.isVector3?(n[12]=t.x,n[13]=t.y,n[14]=t.z):(n[12]=t,n[13]=e,n[14]=i),this}invert(){let t=this.elements,e=t[0],i=t[1],n=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8],u=t[9],d=t[10],f=t[11],p=t[12],_=t[13],m=t[14],g=t[15],b=e*a-i*o,E=e*l-n*o,M=e*c-r*o,T=i*l-n*a,A=i*c-r*a,x=n*c-r*l,S=h*_-u*p,U=h*m-d*p,I=h*g-f*p,D=u*m-d*_,F=u*g-f*_,H=d*g-f*m,C=b*H-E*F+M*D+T*I-A*U+x*S;if(C===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let z=1/C;return t[0]=(a*H-l*F+c*D)*z,t[1]=(n*F-i*H-r*D)*z,t[2]=(_*x-m*A+g*T)*z,t[3]=(d*A-u*x-f*T)*z,t[4]=(l*I-o*H-c*U)*z,t[5]=(e*H-n*I+r*U)*z,t[6]=(m*M-p*x-g*E)*z,t[7]=(h*x-d*M+f*E)*z,t[8]=(o*F-a*I+c*S)*z,t[9]=(i*I-e*F-r*S)*z,t[10]=(p*A-_*M+g*b)*z,t[11]=(u*M-h*A-f*b)*z,t[12]=(a*U-o*D-l*S)*z,t[13]=(e*D-i*U+n*S)*z,t[14]=(_*E-p*T-m*b)*z,t[15]=(h*T-u*E+d*b)*z,this}scale(t){let e=this.elements,i=t.x,n=t.y,r=t.z;return e[0]*=i,e[4]*=n,e[8]*=r,e[1]*=i,e[5]*=n,e[9]*=r,e[2]*=i,e[6]*=n,e[10]*=r,e[3]*=i,e[7]*=n,e[11]*=r,this}getMaxScaleOnAxis(){let t=this.elements,e=t[0]*t[0]+t[1]*t[1]+t[2]*t[2],i=t[4]*t[4]+t[5]*t[5]+t[6]*t[6],n=t[8]*t[8]+t[9]*t[9]+t[10]*t[10];return Math.sqrt(Math.max(e,i,n))}makeTranslation(t,e,i){return t.isVector3?this.set(1,0,0,t.x,0,1,0,t.y,0,0,1,t.z,0,0,0,1):this.set(1,0,0,t,0,1,0,e,0,0,1,i,0,0,0,1),this}makeRotationX(t){let e=Math.cos(t),i=Math.sin(t);return this.set(1,0,0,0,0,e,-i,0,0,i,e,0,0,0,0,1),this}makeRotationY(t){let e=Math.cos(t),i=Math.sin(t);return this.set(e,0,i,0,0,1,0,0,-i,0,e,0,0,0,0,1),this}makeRotationZ(t){let e=Math.cos(t),i=Math.sin(t);return this.set(e,-i,0,0,i,e,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(t,e){let i=Math.cos(e),n=Math.sin(e),r=1-i,o=t.x,a=t.y,l=t.z,c=r*o,h=r*a;return this.set(c*o+i,c*a-n*l,c*l+n*a,0,c*a+n*l,h*a+i,h*l-n*o,0,c*l-n*a,h*l+n*o,r*l*l+i,0,0,0,0,1),this}makeScale(t,e,i){return this.set(t,0,0,0,0,e,0,0,0,0,i,0,0,0,0,1),this}makeShear(t,e,i,n,r,o){return this.set(1,i,r,0,t,1,o,0,e,n,1,0,0,0,0,1),this}compose(t,e,i){let n=this.elements,r=e._x,o=e._y,a=e._z,l=e._w,c=r+r,h=o+o,u=a+a,d=r*c,f=r*h,p=r*u,_=o*h,m=o*u,g=a*u,b=l*c,E=l*h,M=l*u,T=i.x,A=i.y,x=i.z;return n[0]=(1-(_+g))*T,n[1]=(f+M)*T,n[2]=(p-E)*T,n[3]=0,n[4]=(f-M)*A,n[5]=(1-(d+g))*A,n[6]=(m+b)*A,n[7]=0,n[8]=(p+E)*x,n[9]=(m-b)*x,n[10]=(1-(d+_))*x,n[11]=0,n[12]=t.x,n[13]=t.y,n[14]=t.z,n[15]=1,this}decompose(t,e,i){let n=this.elements;t.x=n[12],t.y=n[13],t.z=n[14];let r=this.determinantAffine();if(r===0)return i.set(1,1,1),e.identity(),this;let o=ls.set(n[0],n[1],n[2]).length(),a=ls.set(n[4],n[5],n[6]).length(),l=ls.set(n[8],n[9],n[10]).length();r<0&&(o=-o),Mi.copy(this);let c=1/o,h=1/a,u=1/l;return Mi.elements[0]*=c,Mi.elements[1]*=c,Mi.elements[2]*=c,Mi.elements[4]*=h,Mi.elements[5]*=h,Mi.elements[6]*=h,Mi.elements[8]*=u,Mi.elements[9]*=u,Mi.elements[10]*=u,e.setFromRotationMatrix(Mi),i.x=o,i.y=a,i.z=l,this}makePerspective(t,e,i,n,r,o,a=pi,l=!1){let c=this.elements,h=2*r/(e-t),u=2*r/(i-n),d=(e+t)/(e-t),f=(i+n)/(i-n),p,_;if(l)p=r/(o-r),_=o*r/(o-r);else if(a===pi)p=-(o+r)/(o-r),_=-2*o*r/(o-r);else if(a===Ss)p=-o/(o-r),_=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=d,c[12]=0,c[1]=0,c[5]=u,c[9]=f,c[13]=0,c[2]=0,c[6]=0,c[10]=p,c[14]=_,c[3]=0,c[7]=0,c[11]=-1,c[15]=0,this}makeOrthographic(t,e,i,n,r,o,a=pi,l=!1){let c=this.elements,h=2/(e-t),u=2/(i-n),d=-(e+t)/(e-t),f=-(i+n)/(i-n),p,_;if(l)p=1/(o-r),_=o/(o-r);else if(a===pi)p=-2/(o-r),_=-(o+r)/(o-r);else if(a===Ss)p=-1/(o-r),_=-r/(o-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=0,c[12]=d,c[1]=0,c[5]=u,c[9]=0,c[13]=f,c[2]=0,c[6]=0,c[10]=p,c[14]=_,c[3]=0,c[7]=0,c[11]=0,c[15]=1,this}equals(t){let e=this.elements,i=t.elements;for(let n=0;n<16;n++)if(e[n]!==i[n])return!1;return!0}fromArray(t,e=0){for(let i=0;i<16;i++)this.elements[i]=t[i+e];return this}toArray(t=[],e=0){let i=this.elements;return t[e]=i[0],t[e+1]=i[1],t[e+2]=i[2],t[e+3]=i[3],t[e+4]=i[4],t[e+5]=i[5],t[e+6]=i[6],t[e+7]=i[7],t[e+8]=i[8],t[e+9]=i[9],t[e+10]=i[10],t[e+11]=i[11],t[e+12]=i[12],t[e+13]=i[13],t[e+14]=i[14],t[e+15]=i[15],t}};pl.prototype.isMatrix4=!0;var re=pl,ls=new L,Mi=new re,H0=new L(0,0,0),W0=new L(1,1,1),mn=new L,ta=new L,oi=new L,pf=new re,mf=new Fi,mi=class s{constructor(t=0,e=0,i=0,n=s.DEFAULT_ORDER){this.isEuler=!0,this._x=t,this._y=e,this._z=i,this._order=n}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get order(){return this._order}set order(t){this._order=t,this._onChangeCallback()}set(t,e,i,n=this._order){return this._x=t,this._y=e,this._z=i,this._order=n,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(t){return this._x=t._x,this._y=t._y,this._z=t._z,this._order=t._order,this._onChangeCallback(),this}setFromRotationMatrix(t,e=this._order,i=!0){let n=t.elements,r=n[0],o=n[4],a=n[8],l=n[1],c=n[5],h=n[9],u=n[2],d=n[6],f=n[10];switch(e){case"XYZ":this._y=Math.asin(Qt(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-h,f),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(d,c),this._z=0);break;case"YXZ":this._x=Math.asin(-Qt(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(a,f),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-u,r),this._z=0);break;case"ZXY":this._x=Math.asin(Qt(d,-1,1)),Math.abs(d)<.9999999?(this._y=Math.atan2(-u,f),this._z=Math.atan2(-o,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-Qt(u,-1,1)),Math.abs(u)<.9999999?(this._x=Math.atan2(d,f),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-o,c));break;case"YZX":this._z=Math.asin(Qt(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-h,c),this._y=Math.atan2(-u,r)):(this._x=0,this._y=Math.atan2(a,f));break;case"XZY":this._z=Math.asin(-Qt(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(d,c),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-h,f),this._y=0);break;default:kt("Euler: .setFromRotationMatrix() encountered an unknown order: "+e)}return this._order=e,i===!0&&this._onChangeCallback(),this}setFromQuaternion(t,e,i){return pf.makeRotationFromQuaternion(t),this.setFromRotationMatrix(pf,e,i)}setFromVector3(t,e=this._order){return this.set(t.x,t.y,t.z,e)}reorder(t){return mf.setFromEuler(this),this.setFromQuaternion(mf,t)}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._order===this._order}fromArray(t){return this._x=t[0],this._y=t[1],this._z=t[2],t[3]!==void 0&&(this._order=t[3]),this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._order,t}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};mi.DEFAULT_ORDER="XYZ";var As=class{constructor(){this.mask=1}set(t){this.mask=(1<<t|0)>>>0}enable(t){this.mask|=1<<t|0}enableAll(){this.mask=-1}toggle(t){this.mask^=1<<t|0}disable(t){this.mask&=~(1<<t|0)}disableAll(){this.mask=0}test(t){return(this.mask&t.mask)!==0}isEnabled(t){return(this.mask&(1<<t|0))!==0}},X0=0,gf=new L,cs=new Fi,Zi=new re,ea=new L,cr=new L,q0=new L,$0=new Fi,xf=new L(1,0,0),_f=new L(0,1,0),vf=new L(0,0,1),yf={type:"added"},Y0={type:"removed"},hs={type:"childadded",child:null},ph={type:"childremoved",child:null},Ce=class s extends Oi{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:X0++}),this.uuid=In(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=s.DEFAULT_UP.clone();let t=new L,e=new mi,i=new Fi,n=new L(1,1,1);function r(){i.setFromEuler(e,!1)}function o(){e.setFromQuaternion(i,void 0,!1)}e._onChange(r),i._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:t},rotation:{configurable:!0,enumerable:!0,value:e},quaternion:{configurable:!0,enumerable:!0,value:i},scale:{configurable:!0,enumerable:!0,value:n},modelViewMatrix:{value:new re},normalMatrix:{value:new Gt}}),this.matrix=new re,this.matrixWorld=new re,this.matrixAutoUpdate=s.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=s.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new As,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(t){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(t),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(t){return this.quaternion.premultiply(t),this}setRotationFromAxisAngle(t,e){this.quaternion.setFromAxisAngle(t,e)}setRotationFromEuler(t){this.quaternion.setFromEuler(t,!0)}setRotationFromMatrix(t){this.quaternion.setFromRotationMatrix(t)}setRotationFromQuaternion(t){this.quaternion.copy(t)}rotateOnAxis(t,e){return cs.setFromAxisAngle(t,e),this.quaternion.multiply(cs),this}rotateOnWorldAxis(t,e){return cs.setFromAxisAngle(t,e),this.quaternion.premultiply(cs),this}rotateX(t){return this.rotateOnAxis(xf,t)}rotateY(t){return this.rotateOnAxis(_f,t)}rotateZ(t){return this.rotateOnAxis(vf,t)}translateOnAxis(t,e){return gf.copy(t).applyQuaternion(this.quaternion),this.position.add(gf.multiplyScalar(e)),this}translateX(t){return this.translateOnAxis(xf,t)}translateY(t){return this.translateOnAxis(_f,t)}translateZ(t){return this.translateOnAxis(vf,t)}localToWorld(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(this.matrixWorld)}worldToLocal(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(Zi.copy(this.matrixWorld).invert())}lookAt(t,e,i){t.isVector3?ea.copy(t):ea.set(t,e,i);let n=this.parent;this.updateWorldMatrix(!0,!1),cr.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?Zi.lookAt(cr,ea,this.up):Zi.lookAt(ea,cr,this.up),this.quaternion.setFromRotationMatrix(Zi),n&&(Zi.extractRotation(n.matrixWorld),cs.setFromRotationMatrix(Zi),this.quaternion.premultiply(cs.invert()))}add(t){if(arguments.length>1){for(let e=0;e<arguments.length;e++)this.add(arguments[e]);return this}return t===this?(Bt("Object3D.add: object can't be added as a child of itself.",t),this):(t&&t.isObject3D?(t.removeFromParent(),t.parent=this,this.children.push(t),t.dispatchEvent(yf),hs.child=t,this.dispatchEvent(hs),hs.child=null):Bt("Object3D.add: object not an instance of THREE.Object3D.",t),this)}remove(t){if(arguments.length>1){for(let i=0;i<arguments.length;i++)this.remove(arguments[i]);return this}let e=this.children.indexOf(t);return e!==-1&&(t.parent=null,this.children.splice(e,1),t.dispatchEvent(Y0),ph.child=t,this.dispatchEvent(ph),ph.child=null),this}removeFromParent(){let t=this.parent;return t!==null&&t.remove(this),this}clear(){return this.remove(...this.children)}attach(t){return this.updateWorldMatrix(!0,!1),Zi.copy(this.matrixWorld).invert(),t.parent!==null&&(t.parent.updateWorldMatrix(!0,!1),Zi.multiply(t.parent.matrixWorld)),t.applyMatrix4(Zi),t.removeFromParent(),t.parent=this,this.children.push(t),t.updateWorldMatrix(!1,!0),t.dispatchEvent(yf),hs.child=t,this.dispatchEvent(hs),hs.child=null,this}getObjectById(t){return this.getObjectByProperty("id",t)}getObjectByName(t){return this.getObjectByProperty("name",t)}getObjectByProperty(t,e){if(this[t]===e)return this;for(let i=0,n=this.children.length;i<n;i++){let o=this.children[i].getObjectByProperty(t,e);if(o!==void 0)return o}}getObjectsByProperty(t,e,i=[]){this[t]===e&&i.push(this);let n=this.children;for(let r=0,o=n.length;r<o;r++)n[r].getObjectsByProperty(t,e,i);return i}getWorldPosition(t){return this.updateWorldMatrix(!0,!1),t.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(cr,t,q0),t}getWorldScale(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(cr,$0,t),t}getWorldDirection(t){this.updateWorldMatrix(!0,!1);let e=this.matrixWorld.elements;return t.set(e[8],e[9],e[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(t){t(this);let e=this.children;for(let i=0,n=e.length;i<n;i++)e[i].traverse(t)}traverseVisible(t){if(this.visible===!1)return;t(this);let e=this.children;for(let i=0,n=e.length;i<n;i++)e[i].traverseVisible(t)}traverseAncestors(t){let e=this.parent;e!==null&&(t(e),e.traverseAncestors(t))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let t=this.pivot;if(t!==null){let e=t.x,i=t.y,n=t.z,r=this.matrix.elements;r[12]+=e-r[0]*e-r[4]*i-r[8]*n,r[13]+=i-r[1]*e-r[5]*i-r[9]*n,r[14]+=n-r[2]*e-r[6]*i-r[10]*n}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(t){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||t)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,t=!0);let e=this.children;for(let i=0,n=e.length;i<n;i++)e[i].updateMatrixWorld(t)}updateWorldMatrix(t,e,i=!1){let n=this.parent;if(t===!0&&n!==null&&n.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||i)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,i=!0),e===!0){let r=this.children;for(let o=0,a=r.length;o<a;o++)r[o].updateWorldMatrix(!1,!0,i)}}toJSON(t){let e=t===void 0||typeof t=="string",i={};e&&(t={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},i.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let n={};n.uuid=this.uuid,n.type=this.type,n.name=this.name,n.castShadow=this.castShadow,n.receiveShadow=this.receiveShadow,n.visible=this.visible,n.frustumCulled=this.frustumCulled,n.renderOrder=this.renderOrder,n.static=this.static,n.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(n.userData=this.userData),n.layers=this.layers.mask,n.matrix=this.matrix.toArray(),n.up=this.up.toArray(),this.pivot!==null&&(n.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(n.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(n.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(n.type="InstancedMesh",n.count=this.count,n.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(n.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(n.type="BatchedMesh",n.perObjectFrustumCulled=this.perObjectFrustumCulled,n.sortObjects=this.sortObjects,n.drawRanges=this._drawRanges,n.reservedRanges=this._reservedRanges,n.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),n.instanceInfo=this._instanceInfo.map(a=>({...a})),n.availableInstanceIds=this._availableInstanceIds.slice(),n.availableGeometryIds=this._availableGeometryIds.slice(),n.nextIndexStart=this._nextIndexStart,n.nextVertexStart=this._nextVertexStart,n.geometryCount=this._geometryCount,n.maxInstanceCount=this._maxInstanceCount,n.maxVertexCount=this._maxVertexCount,n.maxIndexCount=this._maxIndexCount,n.geometryInitialized=this._geometryInitialized,n.matricesTexture=this._matricesTexture.toJSON(t),n.indirectTexture=this._indirectTexture.toJSON(t),this._colorsTexture!==null&&(n.colorsTexture=this._colorsTexture.toJSON(t)),this.boundingSphere!==null&&(n.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(n.boundingBox=this.boundingBox.toJSON()));function r(a,l){return a[l.uuid]===void 0&&(a[l.uuid]=l.toJSON(t)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?n.background=this.background.toJSON():this.background.isTexture&&(n.background=this.background.toJSON(t).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(n.environment=this.environment.toJSON(t).uuid);else if(this.isMesh||this.isLine||this.isPoints){n.geometry=r(t.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let l=a.shapes;if(Array.isArray(l))for(let c=0,h=l.length;c<h;c++){let u=l[c];r(t.shapes,u)}else r(t.shapes,l)}}if(this.isSkinnedMesh&&(n.bindMode=this.bindMode,n.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(t.skeletons,this.skeleton),n.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let l=0,c=this.material.length;l<c;l++)a.push(r(t.materials,this.material[l]));n.material=a}else n.material=r(t.materials,this.material);if(this.children.length>0){n.children=[];for(let a=0;a<this.children.length;a++)n.children.push(this.children[a].toJSON(t).object)}if(this.animations.length>0){n.animations=[];for(let a=0;a<this.animations.length;a++){let l=this.animations[a];n.animations.push(r(t.animations,l))}}if(e){let a=o(t.geometries),l=o(t.materials),c=o(t.textures),h=o(t.images),u=o(t.shapes),d=o(t.skeletons),f=o(t.animations),p=o(t.nodes);a.length>0&&(i.geometries=a),l.length>0&&(i.materials=l),c.length>0&&(i.textures=c),h.length>0&&(i.images=h),u.length>0&&(i.shapes=u),d.length>0&&(i.skeletons=d),f.length>0&&(i.animations=f),p.length>0&&(i.nodes=p)}return i.object=n,i;function o(a){let l=[];for(let c in a){let h=a[c];delete h.metadata,l.push(h)}return l}}clone(t){return new this.constructor().copy(this,t)}copy(t,e=!0){if(this.name=t.name,this.up.copy(t.up),this.position.copy(t.position),this.rotation.order=t.rotation.order,this.quaternion.copy(t.quaternion),this.scale.copy(t.scale),this.pivot=t.pivot!==null?t.pivot.clone():null,this.matrix.copy(t.matrix),this.matrixWorld.copy(t.matrixWorld),this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrixWorldAutoUpdate=t.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=t.matrixWorldNeedsUpdate,this.layers.mask=t.layers.mask,this.visible=t.visible,this.castShadow=t.castShadow,this.receiveShadow=t.receiveShadow,this.frustumCulled=t.frustumCulled,this.renderOrder=t.renderOrder,this.static=t.static,this.animations=t.animations.slice(),this.userData=JSON.parse(JSON.stringify(t.userData)),e===!0)for(let i=0;i<t.children.length;i++){let n=t.children[i];this.add(n.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};Ce.DEFAULT_UP=new L(0,1,0);Ce.DEFAULT_MATRIX_AUTO_UPDATE=!0;Ce.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var be=class extends Ce{constructor(){super(),this.isGroup=!0,this.type="Group"}},Z0={type:"move"},Ts=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new be,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new be,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new L,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new L),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new be,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new L,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new L,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(t){return this._targetRay!==null&&this._targetRay.dispatchEvent(t),this._grip!==null&&this._grip.dispatchEvent(t),this._hand!==null&&this._hand.dispatchEvent(t),this}connect(t){if(t&&t.hand){let e=this._hand;if(e)for(let i of t.hand.values())this._getHandJoint(e,i)}return this.dispatchEvent({type:"connected",data:t}),this}disconnect(t){return this.dispatchEvent({type:"disconnected",data:t}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(t,e,i){let n=null,r=null,o=null,a=this._targetRay,l=this._grip,c=this._hand;if(t&&e.session.visibilityState!=="visible-blurred"){if(c&&t.hand){o=!0;for(let _ of t.hand.values()){let m=e.getJointPose(_,i),g=this._getHandJoint(c,_);m!==null&&(g.matrix.fromArray(m.transform.matrix),g.matrix.decompose(g.position,g.quaternion,g.scale),g.matrixWorldNeedsUpdate=!0,g.jointRadius=m.radius),g.visible=m!==null}let h=c.joints["index-finger-tip"],u=c.joints["thumb-tip"],d=h.position.distanceTo(u.position),f=.02,p=.005;c.inputState.pinching&&d>f+p?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:t.handedness,target:this})):!c.inputState.pinching&&d<=f-p&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:t.handedness,target:this}))}else l!==null&&t.gripSpace&&(r=e.getPose(t.gripSpace,i),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.quaternion,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1,l.eventsEnabled&&l.dispatchEvent({type:"gripUpdated",data:t,target:this})));a!==null&&(n=e.getPose(t.targetRaySpace,i),n===null&&r!==null&&(n=r),n!==null&&(a.matrix.fromArray(n.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,n.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(n.linearVelocity)):a.hasLinearVelocity=!1,n.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(n.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(Z0)))}return a!==null&&(a.visible=n!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=o!==null),this}_getHandJoint(t,e){if(t.joints[e.jointName]===void 0){let i=new be;i.matrixAutoUpdate=!1,i.visible=!1,t.joints[e.jointName]=i,t.add(i)}return t.joints[e.jointName]}},Np={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},gn={h:0,s:0,l:0},ia={h:0,s:0,l:0};function mh(s,t,e){return e<0&&(e+=1),e>1&&(e-=1),e<1/6?s+(t-s)*6*e:e<1/2?t:e<2/3?s+(t-s)*6*(2/3-e):s}var Ct=class{constructor(t,e,i){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(t,e,i)}set(t,e,i){if(e===void 0&&i===void 0){let n=t;n&&n.isColor?this.copy(n):typeof n=="number"?this.setHex(n):typeof n=="string"&&this.setStyle(n)}else this.setRGB(t,e,i);return this}setScalar(t){return this.r=t,this.g=t,this.b=t,this}setHex(t,e=Ze){return t=Math.floor(t),this.r=(t>>16&255)/255,this.g=(t>>8&255)/255,this.b=(t&255)/255,ne.colorSpaceToWorking(this,e),this}setRGB(t,e,i,n=ne.workingColorSpace){return this.r=t,this.g=e,this.b=i,ne.colorSpaceToWorking(this,n),this}setHSL(t,e,i,n=ne.workingColorSpace){if(t=B0(t,1),e=Qt(e,0,1),i=Qt(i,0,1),e===0)this.r=this.g=this.b=i;else{let r=i<=.5?i*(1+e):i+e-i*e,o=2*i-r;this.r=mh(o,r,t+1/3),this.g=mh(o,r,t),this.b=mh(o,r,t-1/3)}return ne.colorSpaceToWorking(this,n),this}setStyle(t,e=Ze){function i(r){r!==void 0&&parseFloat(r)<1&&kt("Color: Alpha component of "+t+" will be ignored.")}let n;if(n=/^(\w+)\(([^\)]*)\)/.exec(t)){let r,o=n[1],a=n[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,e);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,e);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,e);break;default:kt("Color: Unknown color model "+t)}}else if(n=/^\#([A-Fa-f\d]+)$/.exec(t)){let r=n[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,e);if(o===6)return this.setHex(parseInt(r,16),e);kt("Color: Invalid hex color "+t)}else if(t&&t.length>0)return this.setColorName(t,e);return this}setColorName(t,e=Ze){let i=Np[t.toLowerCase()];return i!==void 0?this.setHex(i,e):kt("Color: Unknown color "+t),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(t){return this.r=t.r,this.g=t.g,this.b=t.b,this}copySRGBToLinear(t){return this.r=tn(t.r),this.g=tn(t.g),this.b=tn(t.b),this}copyLinearToSRGB(t){return this.r=bs(t.r),this.g=bs(t.g),this.b=bs(t.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(t=Ze){return ne.workingToColorSpace(We.copy(this),t),Math.round(Qt(We.r*255,0,255))*65536+Math.round(Qt(We.g*255,0,255))*256+Math.round(Qt(We.b*255,0,255))}getHexString(t=Ze){return("000000"+this.getHex(t).toString(16)).slice(-6)}getHSL(t,e=ne.workingColorSpace){ne.workingToColorSpace(We.copy(this),e);let i=We.r,n=We.g,r=We.b,o=Math.max(i,n,r),a=Math.min(i,n,r),l,c,h=(a+o)/2;if(a===o)l=0,c=0;else{let u=o-a;switch(c=h<=.5?u/(o+a):u/(2-o-a),o){case i:l=(n-r)/u+(n<r?6:0);break;case n:l=(r-i)/u+2;break;case r:l=(i-n)/u+4;break}l/=6}return t.h=l,t.s=c,t.l=h,t}getRGB(t,e=ne.workingColorSpace){return ne.workingToColorSpace(We.copy(this),e),t.r=We.r,t.g=We.g,t.b=We.b,t}getStyle(t=Ze){ne.workingToColorSpace(We.copy(this),t);let e=We.r,i=We.g,n=We.b;return t!==Ze?`color(${t} ${e.toFixed(3)} ${i.toFixed(3)} ${n.toFixed(3)})`:`rgb(${Math.round(e*255)},${Math.round(i*255)},${Math.round(n*255)})`}offsetHSL(t,e,i){return this.getHSL(gn),this.setHSL(gn.h+t,gn.s+e,gn.l+i)}add(t){return this.r+=t.r,this.g+=t.g,this.b+=t.b,this}addColors(t,e){return this.r=t.r+e.r,this.g=t.g+e.g,this.b=t.b+e.b,this}addScalar(t){return this.r+=t,this.g+=t,this.b+=t,this}sub(t){return this.r=Math.max(0,this.r-t.r),this.g=Math.max(0,this.g-t.g),this.b=Math.max(0,this.b-t.b),this}multiply(t){return this.r*=t.r,this.g*=t.g,this.b*=t.b,this}multiplyScalar(t){return this.r*=t,this.g*=t,this.b*=t,this}lerp(t,e){return this.r+=(t.r-this.r)*e,this.g+=(t.g-this.g)*e,this.b+=(t.b-this.b)*e,this}lerpColors(t,e,i){return this.r=t.r+(e.r-t.r)*i,this.g=t.g+(e.g-t.g)*i,this.b=t.b+(e.b-t.b)*i,this}lerpHSL(t,e){this.getHSL(gn),t.getHSL(ia);let i=ch(gn.h,ia.h,e),n=ch(gn.s,ia.s,e),r=ch(gn.l,ia.l,e);return this.setHSL(i,n,r),this}setFromVector3(t){return this.r=t.x,this.g=t.y,this.b=t.z,this}applyMatrix3(t){let e=this.r,i=this.g,n=this.b,r=t.elements;return this.r=r[0]*e+r[3]*i+r[6]*n,this.g=r[1]*e+r[4]*i+r[7]*n,this.b=r[2]*e+r[5]*i+r[8]*n,this}equals(t){return t.r===this.r&&t.g===this.g&&t.b===this.b}fromArray(t,e=0){return this.r=t[e],this.g=t[e+1],this.b=t[e+2],this}toArray(t=[],e=0){return t[e]=this.r,t[e+1]=this.g,t[e+2]=this.b,t}fromBufferAttribute(t,e){return this.r=t.getX(e),this.g=t.getY(e),this.b=t.getZ(e),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},We=new Ct;Ct.NAMES=Np;var qn=class extends Ce{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new mi,this.environmentIntensity=1,this.environmentRotation=new mi,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(t,e){return super.copy(t,e),this.background=t.background!==null?t.background.clone():null,this.environment=t.environment!==null?t.environment.clone():null,this.fog=t.fog!==null?t.fog.clone():null,this.backgroundBlurriness=t.backgroundBlurriness,this.backgroundIntensity=t.backgroundIntensity,this.backgroundRotation.copy(t.backgroundRotation),this.environmentIntensity=t.environmentIntensity,this.environmentRotation.copy(t.environmentRotation),this.overrideMaterial=t.overrideMaterial!==null?t.overrideMaterial.clone():null,this.matrixAutoUpdate=t.matrixAutoUpdate,this}toJSON(t){let e=super.toJSON(t);return this.fog!==null&&(e.object.fog=this.fog.toJSON()),e.object.backgroundBlurriness=this.backgroundBlurriness,e.object.backgroundIntensity=this.backgroundIntensity,e.object.backgroundRotation=this.backgroundRotation.toArray(),e.object.environmentIntensity=this.environmentIntensity,e.object.environmentRotation=this.environmentRotation.toArray(),e}},Si=new L,Ji=new L,gh=new L,ji=new L,us=new L,ds=new L,bf=new L,xh=new L,_h=new L,vh=new L,yh=new fe,bh=new fe,Mh=new fe,yn=class s{constructor(t=new L,e=new L,i=new L){this.a=t,this.b=e,this.c=i}static getNormal(t,e,i,n){n.subVectors(i,e),Si.subVectors(t,e),n.cross(Si);let r=n.lengthSq();return r>0?n.multiplyScalar(1/Math.sqrt(r)):n.set(0,0,0)}static getBarycoord(t,e,i,n,r){Si.subVectors(n,e),Ji.subVectors(i,e),gh.subVectors(t,e);let o=Si.dot(Si),a=Si.dot(Ji),l=Si.dot(gh),c=Ji.dot(Ji),h=Ji.dot(gh),u=o*c-a*a;if(u===0)return r.set(0,0,0),null;let d=1/u,f=(c*l-a*h)*d,p=(o*h-a*l)*d;return r.set(1-f-p,p,f)}static containsPoint(t,e,i,n){return this.getBarycoord(t,e,i,n,ji)===null?!1:ji.x>=0&&ji.y>=0&&ji.x+ji.y<=1}static getInterpolation(t,e,i,n,r,o,a,l){return this.getBarycoord(t,e,i,n,ji)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,ji.x),l.addScaledVector(o,ji.y),l.addScaledVector(a,ji.z),l)}static getInterpolatedAttribute(t,e,i,n,r,o){return yh.setScalar(0),bh.setScalar(0),Mh.setScalar(0),yh.fromBufferAttribute(t,e),bh.fromBufferAttribute(t,i),Mh.fromBufferAttribute(t,n),o.setScalar(0),o.addScaledVector(yh,r.x),o.addScaledVector(bh,r.y),o.addScaledVector(Mh,r.z),o}static isFrontFacing(t,e,i,n){return Si.subVectors(i,e),Ji.subVectors(t,e),Si.cross(Ji).dot(n)<0}set(t,e,i){return this.a.copy(t),this.b.copy(e),this.c.copy(i),this}setFromPointsAndIndices(t,e,i,n){return this.a.copy(t[e]),this.b.copy(t[i]),this.c.copy(t[n]),this}setFromAttributeAndIndices(t,e,i,n){return this.a.fromBufferAttribute(t,e),this.b.fromBufferAttribute(t,i),this.c.fromBufferAttribute(t,n),this}clone(){return new this.constructor().copy(this)}copy(t){return this.a.copy(t.a),this.b.copy(t.b),this.c.copy(t.c),this}getArea(){return Si.subVectors(this.c,this.b),Ji.subVectors(this.a,this.b),Si.cross(Ji).length()*.5}getMidpoint(t){return t.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(t){return s.getNormal(this.a,this.b,this.c,t)}getPlane(t){return t.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(t,e){return s.getBarycoord(t,this.a,this.b,this.c,e)}getInterpolation(t,e,i,n,r){return s.getInterpolation(t,this.a,this.b,this.c,e,i,n,r)}containsPoint(t){return s.containsPoint(t,this.a,this.b,this.c)}isFrontFacing(t){return s.isFrontFacing(this.a,this.b,this.c,t)}intersectsBox(t){return t.intersectsTriangle(this)}closestPointToPoint(t,e){let i=this.a,n=this.b,r=this.c,o,a;us.subVectors(n,i),ds.subVectors(r,i),xh.subVectors(t,i);let l=us.dot(xh),c=ds.dot(xh);if(l<=0&&c<=0)return e.copy(i);_h.subVectors(t,n);let h=us.dot(_h),u=ds.dot(_h);if(h>=0&&u<=h)return e.copy(n);let d=l*u-h*c;if(d<=0&&l>=0&&h<=0&&l-h>0)return o=l/(l-h),e.copy(i).addScaledVector(us,o);vh.subVectors(t,r);let f=us.dot(vh),p=ds.dot(vh);if(p>=0&&f<=p)return e.copy(r);let _=f*c-l*p;if(_<=0&&c>=0&&p<=0)return a=c/(c-p),e.copy(i).addScaledVector(ds,a);let m=h*p-f*u;if(m<=0&&u-h>=0&&f-p>=0)return bf.subVectors(r,n),a=(u-h)/(u-h+(f-p)),e.copy(n).addScaledVector(bf,a);let g=1/(m+_+d);return o=_*g,a=d*g,e.copy(i).addScaledVector(us,o).addScaledVector(ds,a)}equals(t){return t.a.equals(this.a)&&t.b.equals(this.b)&&t.c.equals(this.c)}},ki=class{constructor(t=new L(1/0,1/0,1/0),e=new L(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=t,this.max=e}set(t,e){return this.min.copy(t),this.max.copy(e),this}setFromArray(t){this.makeEmpty();for(let e=0,i=t.length;e<i;e+=3)this.expandByPoint(wi.fromArray(t,e));return this}setFromBufferAttribute(t){this.makeEmpty();for(let e=0,i=t.count;e<i;e++)this.expandByPoint(wi.fromBufferAttribute(t,e));return this}setFromPoints(t){this.makeEmpty();for(let e=0,i=t.length;e<i;e++)this.expandByPoint(t[e]);return this}setFromCenterAndSize(t,e){let i=wi.copy(e).multiplyScalar(.5);return this.min.copy(t).sub(i),this.max.copy(t).add(i),this}setFromObject(t,e=!1){return this.makeEmpty(),this.expandByObject(t,e)}clone(){return new this.constructor().copy(this)}copy(t){return this.min.copy(t.min),this.max.copy(t.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(t){return this.isEmpty()?t.set(0,0,0):t.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(t){return this.isEmpty()?t.set(0,0,0):t.subVectors(this.max,this.min)}expandByPoint(t){return this.min.min(t),this.max.max(t),this}expandByVector(t){return this.min.sub(t),this.max.add(t),this}expandByScalar(t){return this.min.addScalar(-t),this.max.addScalar(t),this}expandByObject(t,e=!1){t.updateWorldMatrix(!1,!1);let i=t.geometry;if(i!==void 0){let r=i.getAttribute("position");if(e===!0&&r!==void 0&&t.isInstancedMesh!==!0&&t.isBatchedMesh!==!0)for(let o=0,a=r.count;o<a;o++)t.isMesh===!0?t.getVertexPosition(o,wi):wi.fromBufferAttribute(r,o),wi.applyMatrix4(t.matrixWorld),this.expandByPoint(wi);else t.boundingBox!==void 0?(t.boundingBox===null&&t.computeBoundingBox(),na.copy(t.boundingBox)):(i.boundingBox===null&&i.computeBoundingBox(),na.copy(i.boundingBox)),na.applyMatrix4(t.matrixWorld),this.union(na)}let n=t.children;for(let r=0,o=n.length;r<o;r++)this.expandByObject(n[r],e);return this}containsPoint(t){return t.x>=this.min.x&&t.x<=this.max.x&&t.y>=this.min.y&&t.y<=this.max.y&&t.z>=this.min.z&&t.z<=this.max.z}containsBox(t){return this.min.x<=t.min.x&&t.max.x<=this.max.x&&this.min.y<=t.min.y&&t.max.y<=this.max.y&&this.min.z<=t.min.z&&t.max.z<=this.max.z}getParameter(t,e){return e.set((t.x-this.min.x)/(this.max.x-this.min.x),(t.y-this.min.y)/(this.max.y-this.min.y),(t.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(t){return t.max.x>=this.min.x&&t.min.x<=this.max.x&&t.max.y>=this.min.y&&t.min.y<=this.max.y&&t.max.z>=this.min.z&&t.min.z<=this.max.z}intersectsSphere(t){return this.clampPoint(t.center,wi),wi.distanceToSquared(t.center)<=t.radius*t.radius}intersectsPlane(t){let e,i;return t.normal.x>0?(e=t.normal.x*this.min.x,i=t.normal.x*this.max.x):(e=t.normal.x*this.max.x,i=t.normal.x*this.min.x),t.normal.y>0?(e+=t.normal.y*this.min.y,i+=t.normal.y*this.max.y):(e+=t.normal.y*this.max.y,i+=t.normal.y*this.min.y),t.normal.z>0?(e+=t.normal.z*this.min.z,i+=t.normal.z*this.max.z):(e+=t.normal.z*this.max.z,i+=t.normal.z*this.min.z),e<=-t.constant&&i>=-t.constant}intersectsTriangle(t){if(this.isEmpty())return!1;this.getCenter(hr),sa.subVectors(this.max,hr),fs.subVectors(t.a,hr),ps.subVectors(t.b,hr),ms.subVectors(t.c,hr),xn.subVectors(ps,fs),_n.subVectors(ms,ps),Gn.subVectors(fs,ms);let e=[0,-xn.z,xn.y,0,-_n.z,_n.y,0,-Gn.z,Gn.y,xn.z,0,-xn.x,_n.z,0,-_n.x,Gn.z,0,-Gn.x,-xn.y,xn.x,0,-_n.y,_n.x,0,-Gn.y,Gn.x,0];return!Sh(e,fs,ps,ms,sa)||(e=[1,0,0,0,1,0,0,0,1],!Sh(e,fs,ps,ms,sa))?!1:(ra.crossVectors(xn,_n),e=[ra.x,ra.y,ra.z],Sh(e,fs,ps,ms,sa))}clampPoint(t,e){return e.copy(t).clamp(this.min,this.max)}distanceToPoint(t){return this.clampPoint(t,wi).distanceTo(t)}getBoundingSphere(t){return this.isEmpty()?t.makeEmpty():(this.getCenter(t.center),t.radius=this.getSize(wi).length()*.5),t}intersect(t){return this.min.max(t.min),this.max.min(t.max),this.isEmpty()&&this.makeEmpty(),this}union(t){return this.min.min(t.min),this.max.max(t.max),this}applyMatrix4(t){return this.isEmpty()?this:(Ki[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(t),Ki[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(t),Ki[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(t),Ki[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(t),Ki[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(t),Ki[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(t),Ki[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(t),Ki[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(t),this.setFromPoints(Ki),this)}translate(t){return this.min.add(t),this.max.add(t),this}equals(t){return t.min.equals(this.min)&&t.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(t){return this.min.fromArray(t.min),this.max.fromArray(t.max),this}},Ki=[new L,new L,new L,new L,new L,new L,new L,new L],wi=new L,na=new ki,fs=new L,ps=new L,ms=new L,xn=new L,_n=new L,Gn=new L,hr=new L,sa=new L,ra=new L,Vn=new L;function Sh(s,t,e,i,n){for(let r=0,o=s.length-3;r<=o;r+=3){Vn.fromArray(s,r);let a=n.x*Math.abs(Vn.x)+n.y*Math.abs(Vn.y)+n.z*Math.abs(Vn.z),l=t.dot(Vn),c=e.dot(Vn),h=i.dot(Vn);if(Math.max(-Math.max(l,c,h),Math.min(l,c,h))>a)return!1}return!0}var Re=new L,oa=new lt,J0=0,ti=class extends Oi{constructor(t,e,i=!1){if(super(),Array.isArray(t))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:J0++}),this.name="",this.array=t,this.itemSize=e,this.count=t!==void 0?t.length/e:0,this.normalized=i,this.usage=xu,this.updateRanges=[],this.gpuType=xi,this.version=0,this._normalizationScale=t!==void 0?ic(t):void 0}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.name=t.name,this.array=new t.array.constructor(t.array),this.itemSize=t.itemSize,this.count=t.count,this.normalized=t.normalized,this.usage=t.usage,this.gpuType=t.gpuType,this._normalizationScale=t._normalizationScale,this}copyAt(t,e,i){t*=this.itemSize,i*=e.itemSize;for(let n=0,r=this.itemSize;n<r;n++)this.array[t+n]=e.array[i+n];return this}copyArray(t){return this.array.set(t),this}applyMatrix3(t){if(this.itemSize===2)for(let e=0,i=this.count;e<i;e++)oa.fromBufferAttribute(this,e),oa.applyMatrix3(t),this.setXY(e,oa.x,oa.y);else if(this.itemSize===3)for(let e=0,i=this.count;e<i;e++)Re.fromBufferAttribute(this,e),Re.applyMatrix3(t),this.setXYZ(e,Re.x,Re.y,Re.z);return this}applyMatrix4(t){for(let e=0,i=this.count;e<i;e++)Re.fromBufferAttribute(this,e),Re.applyMatrix4(t),this.setXYZ(e,Re.x,Re.y,Re.z);return this}applyNormalMatrix(t){for(let e=0,i=this.count;e<i;e++)Re.fromBufferAttribute(this,e),Re.applyNormalMatrix(t),this.setXYZ(e,Re.x,Re.y,Re.z);return this}transformDirection(t){for(let e=0,i=this.count;e<i;e++)Re.fromBufferAttribute(this,e),Re.transformDirection(t),this.setXYZ(e,Re.x,Re.y,Re.z);return this}set(t,e=0){return this.array.set(t,e),this}getComponent(t,e){let i=this.array[t*this.itemSize+e];return this.normalized&&(i=this._denormalize(i)),i}setComponent(t,e,i){return this.normalized&&(i=this._normalize(i)),this.array[t*this.itemSize+e]=i,this}getX(t){let e=this.array[t*this.itemSize];return this.normalized&&(e=this._denormalize(e)),e}setX(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize]=e,this}getY(t){let e=this.array[t*this.itemSize+1];return this.normalized&&(e=this._denormalize(e)),e}setY(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+1]=e,this}getZ(t){let e=this.array[t*this.itemSize+2];return this.normalized&&(e=this._denormalize(e)),e}setZ(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+2]=e,this}getW(t){let e=this.array[t*this.itemSize+3];return this.normalized&&(e=this._denormalize(e)),e}setW(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+3]=e,this}setXY(t,e,i){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),i=this._normalize(i)),this.array[t+0]=e,this.array[t+1]=i,this}setXYZ(t,e,i,n){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),i=this._normalize(i),n=this._normalize(n)),this.array[t+0]=e,this.array[t+1]=i,this.array[t+2]=n,this}setXYZW(t,e,i,n,r){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),i=this._normalize(i),n=this._normalize(n),r=this._normalize(r)),this.array[t+0]=e,this.array[t+1]=i,this.array[t+2]=n,this.array[t+3]=r,this}onUpload(t){return this.onUploadCallback=t,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let t={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return t.name=this.name,t.usage=this.usage,t.gpuType=this.gpuType,t}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(t){let e=this._normalizationScale;return e!==void 0?Math.max(t/e,-1):Pp(t,this.array)}_normalize(t){let e=this._normalizationScale;return e!==void 0?Math.round(t*e):Lp(t,this.array)}};var Ar=class extends ti{constructor(t,e,i){super(new Uint16Array(t),e,i)}};var Tr=class extends ti{constructor(t,e,i){super(new Uint32Array(t),e,i)}};var qt=class extends ti{constructor(t,e,i){super(new Float32Array(t),e,i)}},j0=new ki,ur=new L,wh=new L,Bi=class{constructor(t=new L,e=-1){this.isSphere=!0,this.center=t,this.radius=e}set(t,e){return this.center.copy(t),this.radius=e,this}setFromPoints(t,e){let i=this.center;e!==void 0?i.copy(e):j0.setFromPoints(t).getCenter(i);let n=0;for(let r=0,o=t.length;r<o;r++)n=Math.max(n,i.distanceToSquared(t[r]));return this.radius=Math.sqrt(n),this}copy(t){return this.center.copy(t.center),this.radius=t.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(t){return t.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(t){return t.distanceTo(this.center)-this.radius}intersectsSphere(t){let e=this.radius+t.radius;return t.center.distanceToSquared(this.center)<=e*e}intersectsBox(t){return t.intersectsSphere(this)}intersectsPlane(t){return Math.abs(t.distanceToPoint(this.center))<=this.radius}clampPoint(t,e){let i=this.center.distanceToSquared(t);return e.copy(t),i>this.radius*this.radius&&(e.sub(this.center).normalize(),e.multiplyScalar(this.radius).add(this.center)),e}getBoundingBox(t){return this.isEmpty()?(t.makeEmpty(),t):(t.set(this.center,this.center),t.expandByScalar(this.radius),t)}applyMatrix4(t){return this.center.applyMatrix4(t),this.radius=this.radius*t.getMaxScaleOnAxis(),this}translate(t){return this.center.add(t),this}expandByPoint(t){if(this.isEmpty())return this.center.copy(t),this.radius=0,this;ur.subVectors(t,this.center);let e=ur.lengthSq();if(e>this.radius*this.radius){let i=Math.sqrt(e),n=(i-this.radius)*.5;this.center.addScaledVector(ur,n/i),this.radius+=n}return this}union(t){return t.isEmpty()?this:this.isEmpty()?(this.copy(t),this):(this.center.equals(t.center)===!0?this.radius=Math.max(this.radius,t.radius):(wh.subVectors(t.center,this.center).setLength(t.radius),this.expandByPoint(ur.copy(t.center).add(wh)),this.expandByPoint(ur.copy(t.center).sub(wh))),this)}equals(t){return t.center.equals(this.center)&&t.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(t){return this.radius=t.radius,this.center.fromArray(t.center),this}},K0=0,fi=new re,Eh=new Ce,gs=new L,ai=new ki,dr=new ki,Ue=new L,_e=class s extends Oi{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:K0++}),this.uuid=In(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(t){return Array.isArray(t)?this.index=new(F0(t)?Tr:Ar)(t,1):this.index=t,this}setIndirect(t,e=0){return this.indirect=t,this.indirectOffset=e,this}getIndirect(){return this.indirect}getAttribute(t){return this.attributes[t]}setAttribute(t,e){return this.attributes[t]=e,this}deleteAttribute(t){return delete this.attributes[t],this}hasAttribute(t){return this.attributes[t]!==void 0}addGroup(t,e,i=0){this.groups.push({start:t,count:e,materialIndex:i})}clearGroups(){this.groups=[]}setDrawRange(t,e){this.drawRange.start=t,this.drawRange.count=e}applyMatrix4(t){let e=this.attributes.position;e!==void 0&&(e.applyMatrix4(t),e.needsUpdate=!0);let i=this.attributes.normal;if(i!==void 0){let r=new Gt().getNormalMatrix(t);i.applyNormalMatrix(r),i.needsUpdate=!0}let n=this.attributes.tangent;return n!==void 0&&(n.transformDirection(t),n.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(t){return fi.makeRotationFromQuaternion(t),this.applyMatrix4(fi),this}rotateX(t){return fi.makeRotationX(t),this.applyMatrix4(fi),this}rotateY(t){return fi.makeRotationY(t),this.applyMatrix4(fi),this}rotateZ(t){return fi.makeRotationZ(t),this.applyMatrix4(fi),this}translate(t,e,i){return fi.makeTranslation(t,e,i),this.applyMatrix4(fi),this}scale(t,e,i){return fi.makeScale(t,e,i),this.applyMatrix4(fi),this}lookAt(t){return Eh.lookAt(t),Eh.updateMatrix(),this.applyMatrix4(Eh.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(gs).negate(),this.translate(gs.x,gs.y,gs.z),this}setFromPoints(t){let e=this.getAttribute("position");if(e===void 0){let i=[];for(let n=0,r=t.length;n<r;n++){let o=t[n];i.push(o.x,o.y,o.z||0)}this.setAttribute("position",new qt(i,3))}else{let i=Math.min(t.length,e.count);for(let n=0;n<i;n++){let r=t[n];e.setXYZ(n,r.x,r.y,r.z||0)}t.length>e.count&&kt("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),e.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new ki);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){Bt("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new L(-1/0,-1/0,-1/0),new L(1/0,1/0,1/0));return}if(t!==void 0){if(this.boundingBox.setFromBufferAttribute(t),e)for(let i=0,n=e.length;i<n;i++){let r=e[i];ai.setFromBufferAttribute(r),this.morphTargetsRelative?(Ue.addVectors(this.boundingBox.min,ai.min),this.boundingBox.expandByPoint(Ue),Ue.addVectors(this.boundingBox.max,ai.max),this.boundingBox.expandByPoint(Ue)):(this.boundingBox.expandByPoint(ai.min),this.boundingBox.expandByPoint(ai.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&Bt('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new Bi);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){Bt("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new L,1/0);return}if(t){let i=this.boundingSphere.center;if(ai.setFromBufferAttribute(t),e)for(let r=0,o=e.length;r<o;r++){let a=e[r];dr.setFromBufferAttribute(a),this.morphTargetsRelative?(Ue.addVectors(ai.min,dr.min),ai.expandByPoint(Ue),Ue.addVectors(ai.max,dr.max),ai.expandByPoint(Ue)):(ai.expandByPoint(dr.min),ai.expandByPoint(dr.max))}ai.getCenter(i);let n=0;for(let r=0,o=t.count;r<o;r++)Ue.fromBufferAttribute(t,r),n=Math.max(n,i.distanceToSquared(Ue));if(e)for(let r=0,o=e.length;r<o;r++){let a=e[r],l=this.morphTargetsRelative;for(let c=0,h=a.count;c<h;c++)Ue.fromBufferAttribute(a,c),l&&(gs.fromBufferAttribute(t,c),Ue.add(gs)),n=Math.max(n,i.distanceToSquared(Ue))}this.boundingSphere.radius=Math.sqrt(n),isNaN(this.boundingSphere.radius)&&Bt('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let t=this.index,e=this.attributes;if(t===null||e.position===void 0||e.normal===void 0||e.uv===void 0){Bt("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let i=e.position,n=e.normal,r=e.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==i.count)&&(o=new ti(new Float32Array(4*i.count),4),this.setAttribute("tangent",o));let a=[],l=[],c=new Uint8Array(i.count);for(let U=0;U<i.count;U++)a[U]=new L,l[U]=new L;let h=new L,u=new L,d=new L,f=new lt,p=new lt,_=new lt,m=new L,g=new L;function b(U,I,D){c[U]=c[I]=c[D]=1,h.fromBufferAttribute(i,U),u.fromBufferAttribute(i,I),d.fromBufferAttribute(i,D),f.fromBufferAttribute(r,U),p.fromBufferAttribute(r,I),_.fromBufferAttribute(r,D),u.sub(h),d.sub(h),p.sub(f),_.sub(f);let F=1/(p.x*_.y-_.x*p.y);isFinite(F)&&(m.copy(u).multiplyScalar(_.y).addScaledVector(d,-p.y).multiplyScalar(F),g.copy(d).multiplyScalar(p.x).addScaledVector(u,-_.x).multiplyScalar(F),a[U].add(m),a[I].add(m),a[D].add(m),l[U].add(g),l[I].add(g),l[D].add(g))}let E=this.groups;E.length===0&&(E=[{start:0,count:t.count}]);for(let U=0,I=E.length;U<I;++U){let D=E[U],F=D.start,H=D.count;for(let C=F,z=F+H;C<z;C+=3)b(t.getX(C+0),t.getX(C+1),t.getX(C+2))}let M=new L,T=new L,A=new L,x=new L;function S(U){A.fromBufferAttribute(n,U),x.copy(A);let I=a[U];M.copy(I),M.sub(A.multiplyScalar(A.dot(I))).normalize(),T.crossVectors(x,I);let F=T.dot(l[U])<0?-1:1;o.setXYZW(U,M.x,M.y,M.z,F)}for(let U=0,I=i.count;U<I;++U)c[U]&&S(U);this._transformed=!0}computeVertexNormals(){let t=this.index,e=this.getAttribute("position");if(e!==void 0){let i=this.getAttribute("normal");if(i===void 0||i.count!==e.count)i=new ti(new Float32Array(e.count*3),3),this.setAttribute("normal",i);else for(let d=0,f=i.count;d<f;d++)i.setXYZ(d,0,0,0);let n=new L,r=new L,o=new L,a=new L,l=new L,c=new L,h=new L,u=new L;if(t)for(let d=0,f=t.count;d<f;d+=3){let p=t.getX(d+0),_=t.getX(d+1),m=t.getX(d+2);n.fromBufferAttribute(e,p),r.fromBufferAttribute(e,_),o.fromBufferAttribute(e,m),h.subVectors(o,r),u.subVectors(n,r),h.cross(u),a.fromBufferAttribute(i,p),l.fromBufferAttribute(i,_),c.fromBufferAttribute(i,m),a.add(h),l.add(h),c.add(h),i.setXYZ(p,a.x,a.y,a.z),i.setXYZ(_,l.x,l.y,l.z),i.setXYZ(m,c.x,c.y,c.z)}else for(let d=0,f=e.count;d<f;d+=3)n.fromBufferAttribute(e,d+0),r.fromBufferAttribute(e,d+1),o.fromBufferAttribute(e,d+2),h.subVectors(o,r),u.subVectors(n,r),h.cross(u),i.setXYZ(d+0,h.x,h.y,h.z),i.setXYZ(d+1,h.x,h.y,h.z),i.setXYZ(d+2,h.x,h.y,h.z);this.normalizeNormals(),i.needsUpdate=!0}}normalizeNormals(){let t=this.attributes.normal;for(let e=0,i=t.count;e<i;e++)Ue.fromBufferAttribute(t,e),Ue.normalize(),t.setXYZ(e,Ue.x,Ue.y,Ue.z)}toNonIndexed(){function t(a,l){let c=a.array,h=a.itemSize,u=a.normalized,d=new c.constructor(l.length*h),f=0,p=0;for(let _=0,m=l.length;_<m;_++){a.isInterleavedBufferAttribute?f=l[_]*a.data.stride+a.offset:f=l[_]*h;for(let g=0;g<h;g++)d[p++]=c[f++]}return new ti(d,h,u)}if(this.index===null)return kt("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let e=new s,i=this.index.array,n=this.attributes;for(let a in n){let l=n[a],c=t(l,i);e.setAttribute(a,c)}let r=this.morphAttributes;for(let a in r){let l=[],c=r[a];for(let h=0,u=c.length;h<u;h++){let d=c[h],f=t(d,i);l.push(f)}e.morphAttributes[a]=l}e.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,l=o.length;a<l;a++){let c=o[a];e.addGroup(c.start,c.count,c.materialIndex)}return e}toJSON(){let t={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(t.uuid=this.uuid,t.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,t.name=this.name,Object.keys(this.userData).length>0&&(t.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let l=this.parameters;for(let c in l)l[c]!==void 0&&(t[c]=l[c]);return t}t.data={attributes:{}};let e=this.index;e!==null&&(t.data.index={type:e.array.constructor.name,array:Array.prototype.slice.call(e.array)});let i=this.attributes;for(let l in i){let c=i[l];t.data.attributes[l]=c.toJSON(t.data)}let n={},r=!1;for(let l in this.morphAttributes){let c=this.morphAttributes[l],h=[];for(let u=0,d=c.length;u<d;u++){let f=c[u];h.push(f.toJSON(t.data))}h.length>0&&(n[l]=h,r=!0)}r&&(t.data.morphAttributes=n,t.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(t.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(t.data.boundingSphere=a.toJSON()),t}clone(){return new this.constructor().copy(this)}copy(t){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let e={};this.name=t.name;let i=t.index;i!==null&&this.setIndex(i.clone());let n=t.attributes;for(let c in n){let h=n[c];this.setAttribute(c,h.clone(e))}let r=t.morphAttributes;for(let c in r){let h=[],u=r[c];for(let d=0,f=u.length;d<f;d++)h.push(u[d].clone(e));this.morphAttributes[c]=h}this.morphTargetsRelative=t.morphTargetsRelative;let o=t.groups;for(let c=0,h=o.length;c<h;c++){let u=o[c];this.addGroup(u.start,u.count,u.materialIndex)}let a=t.boundingBox;a!==null&&(this.boundingBox=a.clone());let l=t.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=t.drawRange.start,this.drawRange.count=t.drawRange.count,this.userData=t.userData,this._transformed=t._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}},Rr=class{constructor(t,e){this.isInterleavedBuffer=!0,this.array=t,this.stride=e,this.count=t!==void 0?t.length/e:0,this.usage=xu,this.updateRanges=[],this.version=0,this.uuid=In()}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.array=new t.array.constructor(t.array),this.count=t.count,this.stride=t.stride,this.usage=t.usage,this}copyAt(t,e,i){t*=this.stride,i*=e.stride;for(let n=0,r=this.stride;n<r;n++)this.array[t+n]=e.array[i+n];return this}set(t,e=0){return this.array.set(t,e),this}clone(t){t.arrayBuffers===void 0&&(t.arrayBuffers={});let e=Mf(this.array);t.arrayBuffers[e]===void 0&&(t.arrayBuffers[e]=this.array.slice(0).buffer);let i=new this.array.constructor(t.arrayBuffers[e]),n=new this.constructor(i,this.stride);return n.setUsage(this.usage),n}onUpload(t){return this.onUploadCallback=t,this}toJSON(t){t.arrayBuffers===void 0&&(t.arrayBuffers={});let e=Mf(this.array);t.arrayBuffers[e]===void 0&&(t.arrayBuffers[e]=Array.from(new Uint32Array(this.array.slice(0).buffer)));let i={uuid:this.uuid,buffer:e,type:this.array.constructor.name,stride:this.stride};return i.usage=this.usage,i}};function Mf(s){return s.buffer._uuid===void 0&&(s.buffer._uuid=In()),s.byteOffset===0&&s.byteLength===s.buffer.byteLength?s.buffer._uuid:s.buffer._uuid+":"+s.byteOffset+":"+s.byteLength}var Ye=new L,Rs=class s{constructor(t,e,i,n=!1){this.isInterleavedBufferAttribute=!0,this.name="",this.data=t,this.itemSize=e,this.offset=i,this.normalized=n,this._normalizationScale=t!==void 0?ic(t.array):void 0}get count(){return this.data.count}get array(){return this.data.array}set needsUpdate(t){this.data.needsUpdate=t}applyMatrix4(t){for(let e=0,i=this.data.count;e<i;e++)Ye.fromBufferAttribute(this,e),Ye.applyMatrix4(t),this.setXYZ(e,Ye.x,Ye.y,Ye.z);return this}applyNormalMatrix(t){for(let e=0,i=this.count;e<i;e++)Ye.fromBufferAttribute(this,e),Ye.applyNormalMatrix(t),this.setXYZ(e,Ye.x,Ye.y,Ye.z);return this}transformDirection(t){for(let e=0,i=this.count;e<i;e++)Ye.fromBufferAttribute(this,e),Ye.transformDirection(t),this.setXYZ(e,Ye.x,Ye.y,Ye.z);return this}getComponent(t,e){let i=this.array[t*this.data.stride+this.offset+e];return this.normalized&&(i=this._denormalize(i)),i}setComponent(t,e,i){return this.normalized&&(i=this._normalize(i)),this.data.array[t*this.data.stride+this.offset+e]=i,this}setX(t,e){return this.normalized&&(e=this._normalize(e)),this.data.array[t*this.data.stride+this.offset]=e,this}setY(t,e){return this.normalized&&(e=this._normalize(e)),this.data.array[t*this.data.stride+this.offset+1]=e,this}setZ(t,e){return this.normalized&&(e=this._normalize(e)),this.data.array[t*this.data.stride+this.offset+2]=e,this}setW(t,e){return this.normalized&&(e=this._normalize(e)),this.data.array[t*this.data.stride+this.offset+3]=e,this}getX(t){let e=this.data.array[t*this.data.stride+this.offset];return this.normalized&&(e=this._denormalize(e)),e}getY(t){let e=this.data.array[t*this.data.stride+this.offset+1];return this.normalized&&(e=this._denormalize(e)),e}getZ(t){let e=this.data.array[t*this.data.stride+this.offset+2];return this.normalized&&(e=this._denormalize(e)),e}getW(t){let e=this.data.array[t*this.data.stride+this.offset+3];return this.normalized&&(e=this._denormalize(e)),e}setXY(t,e,i){return t=t*this.data.stride+this.offset,this.normalized&&(e=this._normalize(e),i=this._normalize(i)),this.data.array[t+0]=e,this.data.array[t+1]=i,this}setXYZ(t,e,i,n){return t=t*this.data.stride+this.offset,this.normalized&&(e=this._normalize(e),i=this._normalize(i),n=this._normalize(n)),this.data.array[t+0]=e,this.data.array[t+1]=i,this.data.array[t+2]=n,this}setXYZW(t,e,i,n,r){return t=t*this.data.stride+this.offset,this.normalized&&(e=this._normalize(e),i=this._normalize(i),n=this._normalize(n),r=this._normalize(r)),this.data.array[t+0]=e,this.data.array[t+1]=i,this.data.array[t+2]=n,this.data.array[t+3]=r,this}clone(t){if(t===void 0){wr("InterleavedBufferAttribute.clone(): Cloning an interleaved buffer attribute will de-interleave buffer data.");let e=[];for(let i=0;i<this.count;i++){let n=i*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)e.push(this.data.array[n+r])}return new ti(new this.array.constructor(e),this.itemSize,this.normalized)}else return t.interleavedBuffers===void 0&&(t.interleavedBuffers={}),t.interleavedBuffers[this.data.uuid]===void 0&&(t.interleavedBuffers[this.data.uuid]=this.data.clone(t)),new s(t.interleavedBuffers[this.data.uuid],this.itemSize,this.offset,this.normalized)}toJSON(t){if(t===void 0){wr("InterleavedBufferAttribute.toJSON(): Serializing an interleaved buffer attribute will de-interleave buffer data.");let e=[];for(let i=0;i<this.count;i++){let n=i*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)e.push(this.data.array[n+r])}return{itemSize:this.itemSize,type:this.array.constructor.name,array:e,normalized:this.normalized}}else return t.interleavedBuffers===void 0&&(t.interleavedBuffers={}),t.interleavedBuffers[this.data.uuid]===void 0&&(t.interleavedBuffers[this.data.uuid]=this.data.toJSON(t)),{isInterleavedBufferAttribute:!0,itemSize:this.itemSize,data:this.data.uuid,offset:this.offset,normalized:this.normalized}}_denormalize(t){let e=this._normalizationScale;return e!==void 0?Math.max(t/e,-1):Pp(t,this.data.array)}_normalize(t){let e=this._normalizationScale;return e!==void 0?Math.round(t*e):Lp(t,this.data.array)}},Ah=new L,Q0=new L,tx=new Gt,Ei=class{constructor(t=new L(1,0,0),e=0){this.isPlane=!0,this.normal=t,this.constant=e}set(t,e){return this.normal.copy(t),this.constant=e,this}setComponents(t,e,i,n){return this.normal.set(t,e,i),this.constant=n,this}setFromNormalAndCoplanarPoint(t,e){return this.normal.copy(t),this.constant=-e.dot(this.normal),this}setFromCoplanarPoints(t,e,i){let n=Ah.subVectors(i,e).cross(Q0.subVectors(t,e)).normalize();return this.setFromNormalAndCoplanarPoint(n,t),this}copy(t){return this.normal.copy(t.normal),this.constant=t.constant,this}normalize(){let t=1/this.normal.length();return this.normal.multiplyScalar(t),this.constant*=t,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(t){return this.normal.dot(t)+this.constant}distanceToSphere(t){return this.distanceToPoint(t.center)-t.radius}projectPoint(t,e){return e.copy(t).addScaledVector(this.normal,-this.distanceToPoint(t))}intersectLine(t,e,i=!0){let n=t.delta(Ah),r=this.normal.dot(n);if(r===0)return this.distanceToPoint(t.start)===0?e.copy(t.start):null;let o=-(t.start.dot(this.normal)+this.constant)/r;return i===!0&&(o<0||o>1)?null:e.copy(t.start).addScaledVector(n,o)}intersectsLine(t){let e=this.distanceToPoint(t.start),i=this.distanceToPoint(t.end);return e<0&&i>0||i<0&&e>0}intersectsBox(t){return t.intersectsPlane(this)}intersectsSphere(t){return t.intersectsPlane(this)}coplanarPoint(t){return t.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(t,e){let i=e||tx.getNormalMatrix(t),n=this.coplanarPoint(Ah).applyMatrix4(t),r=this.normal.applyMatrix3(i).normalize();return this.constant=-n.dot(r),this}translate(t){return this.constant-=t.dot(this.normal),this}equals(t){return t.normal.equals(this.normal)&&t.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(t){return this.normal.fromArray(t.normal),this.constant=t.constant,this}},ex=0,gi=class extends Oi{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:ex++}),this.uuid=In(),this.name="",this.type="Material",this.blending=ks,this.side=Rn,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=Kh,this.blendDst=Qh,this.blendEquation=Kn,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new Ct(0,0,0),this.blendAlpha=0,this.depthFunc=Ms,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=yp,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=Ra,this.stencilZFail=Ra,this.stencilZPass=Ra,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(t){this._alphaTest>0!=t>0&&this.version++,this._alphaTest=t}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(t){if(t!==void 0)for(let e in t){let i=t[e];if(i===void 0){kt(`Material: parameter '${e}' has value of undefined.`);continue}let n=this[e];if(n===void 0){kt(`Material: '${e}' is not a property of THREE.${this.type}.`);continue}n&&n.isColor?n.set(i):n&&n.isVector2&&i&&i.isVector2||n&&n.isEuler&&i&&i.isEuler||n&&n.isVector3&&i&&i.isVector3?n.copy(i):this[e]=i}}toJSON(t){let e=t===void 0||typeof t=="string";e&&(t={textures:{},images:{}});let i={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};i.uuid=this.uuid,i.type=this.type,i.blending=this.blending,i.side=this.side,i.shadowSide=this.shadowSide,i.vertexColors=this.vertexColors,i.opacity=this.opacity,i.transparent=this.transparent,i.blendSrc=this.blendSrc,i.blendDst=this.blendDst,i.blendEquation=this.blendEquation,i.blendSrcAlpha=this.blendSrcAlpha,i.blendDstAlpha=this.blendDstAlpha,i.blendEquationAlpha=this.blendEquationAlpha,i.blendColor=this.blendColor.getHex(),i.blendAlpha=this.blendAlpha,i.depthFunc=this.depthFunc,i.depthTest=this.depthTest,i.depthWrite=this.depthWrite,i.colorWrite=this.colorWrite,i.clipIntersection=this.clipIntersection,i.clipShadows=this.clipShadows,i.stencilWriteMask=this.stencilWriteMask,i.stencilFunc=this.stencilFunc,i.stencilRef=this.stencilRef,i.stencilFuncMask=this.stencilFuncMask,i.stencilFail=this.stencilFail,i.stencilZFail=this.stencilZFail,i.stencilZPass=this.stencilZPass,i.stencilWrite=this.stencilWrite,i.polygonOffset=this.polygonOffset,i.polygonOffsetFactor=this.polygonOffsetFactor,i.polygonOffsetUnits=this.polygonOffsetUnits,i.dithering=this.dithering,i.alphaTest=this.alphaTest,i.alphaHash=this.alphaHash,i.alphaToCoverage=this.alphaToCoverage,i.premultipliedAlpha=this.premultipliedAlpha,i.forceSinglePass=this.forceSinglePass,i.allowOverride=this.allowOverride,i.visible=this.visible,i.toneMapped=this.toneMapped,i.name=this.name,this.color&&this.color.isColor&&(i.color=this.color.getHex()),this.roughness!==void 0&&(i.roughness=this.roughness),this.metalness!==void 0&&(i.metalness=this.metalness),this.sheen!==void 0&&(i.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(i.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(i.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(i.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(i.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(i.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(i.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(i.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(i.shininess=this.shininess),this.clearcoat!==void 0&&(i.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(i.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(i.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(i.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(t).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(i.clearcoatMap=this.clearcoatMap.toJSON(t).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(i.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(t).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(i.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(t).uuid,i.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(i.sheenColorMap=this.sheenColorMap.toJSON(t).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(i.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(t).uuid),this.dispersion!==void 0&&(i.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(i.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(i.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(i.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(i.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(i.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(i.iridescenceMap=this.iridescenceMap.toJSON(t).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(i.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(t).uuid),this.anisotropy!==void 0&&(i.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(i.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(i.anisotropyMap=this.anisotropyMap.toJSON(t).uuid),this.map&&this.map.isTexture&&(i.map=this.map.toJSON(t).uuid),this.matcap&&this.matcap.isTexture&&(i.matcap=this.matcap.toJSON(t).uuid),this.alphaMap&&this.alphaMap.isTexture&&(i.alphaMap=this.alphaMap.toJSON(t).uuid),this.lightMap&&this.lightMap.isTexture&&(i.lightMap=this.lightMap.toJSON(t).uuid,i.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(i.aoMap=this.aoMap.toJSON(t).uuid,i.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(i.bumpMap=this.bumpMap.toJSON(t).uuid,i.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(i.normalMap=this.normalMap.toJSON(t).uuid,i.normalMapType=this.normalMapType,i.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(i.displacementMap=this.displacementMap.toJSON(t).uuid,i.displacementScale=this.displacementScale,i.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(i.roughnessMap=this.roughnessMap.toJSON(t).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(i.metalnessMap=this.metalnessMap.toJSON(t).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(i.emissiveMap=this.emissiveMap.toJSON(t).uuid),this.specularMap&&this.specularMap.isTexture&&(i.specularMap=this.specularMap.toJSON(t).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(i.specularIntensityMap=this.specularIntensityMap.toJSON(t).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(i.specularColorMap=this.specularColorMap.toJSON(t).uuid),this.envMap&&this.envMap.isTexture&&(i.envMap=this.envMap.toJSON(t).uuid,this.combine!==void 0&&(i.combine=this.combine)),this.envMapRotation!==void 0&&(i.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(i.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(i.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(i.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(i.gradientMap=this.gradientMap.toJSON(t).uuid),this.transmission!==void 0&&(i.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(i.transmissionMap=this.transmissionMap.toJSON(t).uuid),this.thickness!==void 0&&(i.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(i.thicknessMap=this.thicknessMap.toJSON(t).uuid),this.attenuationDistance!==void 0&&(i.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(i.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(i.size=this.size),this.sizeAttenuation!==void 0&&(i.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(i.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(i.rotation=this.rotation),this.depthPacking!==void 0&&(i.depthPacking=this.depthPacking),this.linewidth!==void 0&&(i.linewidth=this.linewidth),this.linecap!==void 0&&(i.linecap=this.linecap),this.linejoin!==void 0&&(i.linejoin=this.linejoin),this.dashSize!==void 0&&(i.dashSize=this.dashSize),this.gapSize!==void 0&&(i.gapSize=this.gapSize),this.scale!==void 0&&(i.scale=this.scale),this.wireframe!==void 0&&(i.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(i.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(i.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(i.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(i.flatShading=this.flatShading),this.fog!==void 0&&(i.fog=this.fog),Object.keys(this.userData).length>0&&(i.userData=this.userData);function n(r){let o=[];for(let a in r){let l=r[a];delete l.metadata,o.push(l)}return o}if(e){let r=n(t.textures),o=n(t.images);r.length>0&&(i.textures=r),o.length>0&&(i.images=o)}return i}fromJSON(t,e){if(t.uuid!==void 0&&(this.uuid=t.uuid),t.name!==void 0&&(this.name=t.name),t.color!==void 0&&this.color!==void 0&&this.color.setHex(t.color),t.roughness!==void 0&&(this.roughness=t.roughness),t.metalness!==void 0&&(this.metalness=t.metalness),t.sheen!==void 0&&(this.sheen=t.sheen),t.sheenColor!==void 0&&(this.sheenColor=new Ct().setHex(t.sheenColor)),t.sheenRoughness!==void 0&&(this.sheenRoughness=t.sheenRoughness),t.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(t.emissive),t.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(t.specular),t.specularIntensity!==void 0&&(this.specularIntensity=t.specularIntensity),t.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(t.specularColor),t.shininess!==void 0&&(this.shininess=t.shininess),t.clearcoat!==void 0&&(this.clearcoat=t.clearcoat),t.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=t.clearcoatRoughness),t.diffuseRoughness!==void 0&&(this.diffuseRoughness=t.diffuseRoughness),t.dispersion!==void 0&&(this.dispersion=t.dispersion),t.retroreflectivity!==void 0&&(this.retroreflectivity=t.retroreflectivity),t.iridescence!==void 0&&(this.iridescence=t.iridescence),t.iridescenceIOR!==void 0&&(this.iridescenceIOR=t.iridescenceIOR),t.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessMinimum),t.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=t.iridescenceThicknessMaximum),t.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=t.iridescenceThicknessRange[1]),t.transmission!==void 0&&(this.transmission=t.transmission),t.thickness!==void 0&&(this.thickness=t.thickness),t.attenuationDistance!==void 0&&(this.attenuationDistance=t.attenuationDistance),t.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(t.attenuationColor),t.anisotropy!==void 0&&(this.anisotropy=t.anisotropy),t.anisotropyRotation!==void 0&&(this.anisotropyRotation=t.anisotropyRotation),t.fog!==void 0&&(this.fog=t.fog),t.flatShading!==void 0&&(this.flatShading=t.flatShading),t.blending!==void 0&&(this.blending=t.blending),t.combine!==void 0&&(this.combine=t.combine),t.side!==void 0&&(this.side=t.side),t.shadowSide!==void 0&&(this.shadowSide=t.shadowSide),t.opacity!==void 0&&(this.opacity=t.opacity),t.transparent!==void 0&&(this.transparent=t.transparent),t.alphaTest!==void 0&&(this.alphaTest=t.alphaTest),t.alphaHash!==void 0&&(this.alphaHash=t.alphaHash),t.depthFunc!==void 0&&(this.depthFunc=t.depthFunc),t.depthTest!==void 0&&(this.depthTest=t.depthTest),t.depthWrite!==void 0&&(this.depthWrite=t.depthWrite),t.colorWrite!==void 0&&(this.colorWrite=t.colorWrite),t.clippingPlanes!==void 0&&(this.clippingPlanes=t.clippingPlanes.map(i=>new Ei().fromJSON(i))),t.clipIntersection!==void 0&&(this.clipIntersection=t.clipIntersection),t.clipShadows!==void 0&&(this.clipShadows=t.clipShadows),t.depthPacking!==void 0&&(this.depthPacking=t.depthPacking),t.blendSrc!==void 0&&(this.blendSrc=t.blendSrc),t.blendDst!==void 0&&(this.blendDst=t.blendDst),t.blendEquation!==void 0&&(this.blendEquation=t.blendEquation),t.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=t.blendSrcAlpha),t.blendDstAlpha!==void 0&&(this.blendDstAlpha=t.blendDstAlpha),t.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=t.blendEquationAlpha),t.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(t.blendColor),t.blendAlpha!==void 0&&(this.blendAlpha=t.blendAlpha),t.stencilWriteMask!==void 0&&(this.stencilWriteMask=t.stencilWriteMask),t.stencilFunc!==void 0&&(this.stencilFunc=t.stencilFunc),t.stencilRef!==void 0&&(this.stencilRef=t.stencilRef),t.stencilFuncMask!==void 0&&(this.stencilFuncMask=t.stencilFuncMask),t.stencilFail!==void 0&&(this.stencilFail=t.stencilFail),t.stencilZFail!==void 0&&(this.stencilZFail=t.stencilZFail),t.stencilZPass!==void 0&&(this.stencilZPass=t.stencilZPass),t.stencilWrite!==void 0&&(this.stencilWrite=t.stencilWrite),t.wireframe!==void 0&&(this.wireframe=t.wireframe),t.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=t.wireframeLinewidth),t.wireframeLinecap!==void 0&&(this.wireframeLinecap=t.wireframeLinecap),t.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=t.wireframeLinejoin),t.rotation!==void 0&&(this.rotation=t.rotation),t.linewidth!==void 0&&(this.linewidth=t.linewidth),t.linecap!==void 0&&(this.linecap=t.linecap),t.linejoin!==void 0&&(this.linejoin=t.linejoin),t.dashSize!==void 0&&(this.dashSize=t.dashSize),t.gapSize!==void 0&&(this.gapSize=t.gapSize),t.scale!==void 0&&(this.scale=t.scale),t.polygonOffset!==void 0&&(this.polygonOffset=t.polygonOffset),t.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=t.polygonOffsetFactor),t.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=t.polygonOffsetUnits),t.dithering!==void 0&&(this.dithering=t.dithering),t.alphaToCoverage!==void 0&&(this.alphaToCoverage=t.alphaToCoverage),t.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=t.premultipliedAlpha),t.forceSinglePass!==void 0&&(this.forceSinglePass=t.forceSinglePass),t.allowOverride!==void 0&&(this.allowOverride=t.allowOverride),t.visible!==void 0&&(this.visible=t.visible),t.toneMapped!==void 0&&(this.toneMapped=t.toneMapped),t.userData!==void 0&&(this.userData=t.userData),t.vertexColors!==void 0&&(typeof t.vertexColors=="number"?this.vertexColors=t.vertexColors>0:this.vertexColors=t.vertexColors),t.size!==void 0&&(this.size=t.size),t.sizeAttenuation!==void 0&&(this.sizeAttenuation=t.sizeAttenuation),t.map!==void 0&&(this.map=e[t.map]||null),t.matcap!==void 0&&(this.matcap=e[t.matcap]||null),t.alphaMap!==void 0&&(this.alphaMap=e[t.alphaMap]||null),t.bumpMap!==void 0&&(this.bumpMap=e[t.bumpMap]||null),t.bumpScale!==void 0&&(this.bumpScale=t.bumpScale),t.normalMap!==void 0&&(this.normalMap=e[t.normalMap]||null),t.normalMapType!==void 0&&(this.normalMapType=t.normalMapType),t.normalScale!==void 0){let i=t.normalScale;Array.isArray(i)===!1&&(i=[i,i]),this.normalScale=new lt().fromArray(i)}return t.displacementMap!==void 0&&(this.displacementMap=e[t.displacementMap]||null),t.displacementScale!==void 0&&(this.displacementScale=t.displacementScale),t.displacementBias!==void 0&&(this.displacementBias=t.displacementBias),t.roughnessMap!==void 0&&(this.roughnessMap=e[t.roughnessMap]||null),t.metalnessMap!==void 0&&(this.metalnessMap=e[t.metalnessMap]||null),t.emissiveMap!==void 0&&(this.emissiveMap=e[t.emissiveMap]||null),t.emissiveIntensity!==void 0&&(this.emissiveIntensity=t.emissiveIntensity),t.specularMap!==void 0&&(this.specularMap=e[t.specularMap]||null),t.specularIntensityMap!==void 0&&(this.specularIntensityMap=e[t.specularIntensityMap]||null),t.specularColorMap!==void 0&&(this.specularColorMap=e[t.specularColorMap]||null),t.envMap!==void 0&&(this.envMap=e[t.envMap]||null),t.envMapRotation!==void 0&&this.envMapRotation.fromArray(t.envMapRotation),t.envMapIntensity!==void 0&&(this.envMapIntensity=t.envMapIntensity),t.reflectivity!==void 0&&(this.reflectivity=t.reflectivity),t.refractionRatio!==void 0&&(this.refractionRatio=t.refractionRatio),t.lightMap!==void 0&&(this.lightMap=e[t.lightMap]||null),t.lightMapIntensity!==void 0&&(this.lightMapIntensity=t.lightMapIntensity),t.aoMap!==void 0&&(this.aoMap=e[t.aoMap]||null),t.aoMapIntensity!==void 0&&(this.aoMapIntensity=t.aoMapIntensity),t.gradientMap!==void 0&&(this.gradientMap=e[t.gradientMap]||null),t.clearcoatMap!==void 0&&(this.clearcoatMap=e[t.clearcoatMap]||null),t.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=e[t.clearcoatRoughnessMap]||null),t.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=e[t.clearcoatNormalMap]||null),t.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new lt().fromArray(t.clearcoatNormalScale)),t.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=e[t.diffuseRoughnessMap]||null),t.iridescenceMap!==void 0&&(this.iridescenceMap=e[t.iridescenceMap]||null),t.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=e[t.iridescenceThicknessMap]||null),t.transmissionMap!==void 0&&(this.transmissionMap=e[t.transmissionMap]||null),t.thicknessMap!==void 0&&(this.thicknessMap=e[t.thicknessMap]||null),t.anisotropyMap!==void 0&&(this.anisotropyMap=e[t.anisotropyMap]||null),t.sheenColorMap!==void 0&&(this.sheenColorMap=e[t.sheenColorMap]||null),t.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=e[t.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(t){this.name=t.name,this.blending=t.blending,this.side=t.side,this.vertexColors=t.vertexColors,this.opacity=t.opacity,this.transparent=t.transparent,this.blendSrc=t.blendSrc,this.blendDst=t.blendDst,this.blendEquation=t.blendEquation,this.blendSrcAlpha=t.blendSrcAlpha,this.blendDstAlpha=t.blendDstAlpha,this.blendEquationAlpha=t.blendEquationAlpha,this.blendColor.copy(t.blendColor),this.blendAlpha=t.blendAlpha,this.depthFunc=t.depthFunc,this.depthTest=t.depthTest,this.depthWrite=t.depthWrite,this.stencilWriteMask=t.stencilWriteMask,this.stencilFunc=t.stencilFunc,this.stencilRef=t.stencilRef,this.stencilFuncMask=t.stencilFuncMask,this.stencilFail=t.stencilFail,this.stencilZFail=t.stencilZFail,this.stencilZPass=t.stencilZPass,this.stencilWrite=t.stencilWrite;let e=t.clippingPlanes,i=null;if(e!==null){let n=e.length;i=new Array(n);for(let r=0;r!==n;++r)i[r]=e[r].clone()}return this.clippingPlanes=i,this.clipIntersection=t.clipIntersection,this.clipShadows=t.clipShadows,this.shadowSide=t.shadowSide,this.colorWrite=t.colorWrite,this.precision=t.precision,this.polygonOffset=t.polygonOffset,this.polygonOffsetFactor=t.polygonOffsetFactor,this.polygonOffsetUnits=t.polygonOffsetUnits,this.dithering=t.dithering,this.alphaTest=t.alphaTest,this.alphaHash=t.alphaHash,this.alphaToCoverage=t.alphaToCoverage,this.premultipliedAlpha=t.premultipliedAlpha,this.forceSinglePass=t.forceSinglePass,this.allowOverride=t.allowOverride,this.visible=t.visible,this.toneMapped=t.toneMapped,this.userData=JSON.parse(JSON.stringify(t.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(t){t===!0&&this.version++}};var Qi=new L,Th=new L,aa=new L,la=new L,$n=class{constructor(t=new L,e=new L(0,0,-1)){this.origin=t,this.direction=e}set(t,e){return this.origin.copy(t),this.direction.copy(e),this}copy(t){return this.origin.copy(t.origin),this.direction.copy(t.direction),this}at(t,e){return e.copy(this.origin).addScaledVector(this.direction,t)}lookAt(t){return this.direction.copy(t).sub(this.origin).normalize(),this}recast(t){return this.origin.copy(this.at(t,Qi)),this}closestPointToPoint(t,e){e.subVectors(t,this.origin);let i=e.dot(this.direction);return i<0?e.copy(this.origin):e.copy(this.origin).addScaledVector(this.direction,i)}distanceToPoint(t){return Math.sqrt(this.distanceSqToPoint(t))}distanceSqToPoint(t){let e=Qi.subVectors(t,this.origin).dot(this.direction);return e<0?this.origin.distanceToSquared(t):(Qi.copy(this.origin).addScaledVector(this.direction,e),Qi.distanceToSquared(t))}distanceSqToSegment(t,e,i,n){Th.copy(t).add(e).multiplyScalar(.5),aa.copy(e).sub(t).normalize(),la.copy(this.origin).sub(Th);let r=t.distanceTo(e)*.5,o=-this.direction.dot(aa),a=la.dot(this.direction),l=-la.dot(aa),c=la.lengthSq(),h=Math.abs(1-o*o),u,d,f,p;if(h>0)if(u=o*l-a,d=o*a-l,p=r*h,u>=0)if(d>=-p)if(d<=p){let _=1/h;u*=_,d*=_,f=u*(u+o*d+2*a)+d*(o*u+d+2*l)+c}else d=r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d=-r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d<=-p?(u=Math.max(0,-(-o*r+a)),d=u>0?-r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c):d<=p?(u=0,d=Math.min(Math.max(-r,-l),r),f=d*(d+2*l)+c):(u=Math.max(0,-(o*r+a)),d=u>0?r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c);else d=o>0?-r:r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;return i&&i.copy(this.origin).addScaledVector(this.direction,u),n&&n.copy(Th).addScaledVector(aa,d),f}intersectSphere(t,e){if(t.radius<0)return null;Qi.subVectors(t.center,this.origin);let i=Qi.dot(this.direction),n=Qi.dot(Qi)-i*i,r=t.radius*t.radius;if(n>r)return null;let o=Math.sqrt(r-n),a=i-o,l=i+o;return l<0?null:a<0?this.at(l,e):this.at(a,e)}intersectsSphere(t){return t.radius<0?!1:this.distanceSqToPoint(t.center)<=t.radius*t.radius}distanceToPlane(t){let e=t.normal.dot(this.direction);if(e===0)return t.distanceToPoint(this.origin)===0?0:null;let i=-(this.origin.dot(t.normal)+t.constant)/e;return i>=0?i:null}intersectPlane(t,e){let i=this.distanceToPlane(t);return i===null?null:this.at(i,e)}intersectsPlane(t){let e=t.distanceToPoint(this.origin);return e===0||t.normal.dot(this.direction)*e<0}intersectBox(t,e){let i,n,r,o,a,l,c=1/this.direction.x,h=1/this.direction.y,u=1/this.direction.z,d=this.origin;return c>=0?(i=(t.min.x-d.x)*c,n=(t.max.x-d.x)*c):(i=(t.max.x-d.x)*c,n=(t.min.x-d.x)*c),h>=0?(r=(t.min.y-d.y)*h,o=(t.max.y-d.y)*h):(r=(t.max.y-d.y)*h,o=(t.min.y-d.y)*h),i>o||r>n||((r>i||isNaN(i))&&(i=r),(o<n||isNaN(n))&&(n=o),u>=0?(a=(t.min.z-d.z)*u,l=(t.max.z-d.z)*u):(a=(t.max.z-d.z)*u,l=(t.min.z-d.z)*u),i>l||a>n)||((a>i||i!==i)&&(i=a),(l<n||n!==n)&&(n=l),n<0)?null:this.at(i>=0?i:n,e)}intersectsBox(t){return this.intersectBox(t,Qi)!==null}intersectTriangle(t,e,i,n,r){let o=this.origin,a=this.direction,l=a.x,c=a.y,h=a.z,u=t.x-o.x,d=t.y-o.y,f=t.z-o.z,p=e.x-o.x,_=e.y-o.y,m=e.z-o.z,g=i.x-o.x,b=i.y-o.y,E=i.z-o.z,M=Math.abs(l),T=Math.abs(c),A=Math.abs(h),x,S,U,I,D,F,H,C,z,X,G,et;if(M>=T&&M>=A?(U=l,F=u,z=p,et=g,l>=0?(x=c,S=h,I=d,D=f,H=_,C=m,X=b,G=E):(x=h,S=c,I=f,D=d,H=m,C=_,X=E,G=b)):T>=A?(U=c,F=d,z=_,et=b,c>=0?(x=h,S=l,I=f,D=u,H=m,C=p,X=E,G=g):(x=l,S=h,I=u,D=f,H=p,C=m,X=g,G=E)):(U=h,F=f,z=m,et=E,h>=0?(x=l,S=c,I=u,D=d,H=p,C=_,X=g,G=b):(x=c,S=l,I=d,D=u,H=_,C=p,X=b,G=g)),U===0)return null;let W=x/U,K=S/U,tt=1/U,St=I-W*F,Ot=D-K*F,$=H-W*z,xt=C-K*z,wt=X-W*et,Nt=G-K*et,_t=wt*xt-Nt*$,Dt=St*Nt-Ot*wt,pe=$*Ot-xt*St;if(n){if(_t<0||Dt<0||pe<0)return null}else if((_t<0||Dt<0||pe<0)&&(_t>0||Dt>0||pe>0))return null;let Ft=_t+Dt+pe;if(Ft===0)return null;let Zt=tt*(_t*F+Dt*z+pe*et);return(Ft>0?Zt<0:Zt>0)?null:this.at(Zt/Ft,r)}applyMatrix4(t){return this.origin.applyMatrix4(t),this.direction.transformDirection(t),this}equals(t){return t.origin.equals(this.origin)&&t.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},Ai=class extends gi{constructor(t){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new Ct(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new mi,this.combine=ml,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.fog=t.fog,this}},Sf=new re,Hn=new $n,ca=new Bi,wf=new L,ha=new L,ua=new L,da=new L,Rh=new L,fa=new L,Ef=new L,pa=new L,Wt=class extends Ce{constructor(t=new _e,e=new Ai){super(),this.isMesh=!0,this.type="Mesh",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}updateMorphTargets(){let e=this.geometry.morphAttributes,i=Object.keys(e);if(i.length>0){let n=e[i[0]];if(n!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=n.length;r<o;r++){let a=n[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(t,e){let i=this.geometry,n=i.attributes.position,r=i.morphAttributes.position,o=i.morphTargetsRelative;e.fromBufferAttribute(n,t);let a=this.morphTargetInfluences;if(r&&a){fa.set(0,0,0);for(let l=0,c=r.length;l<c;l++){let h=a[l],u=r[l];h!==0&&(Rh.fromBufferAttribute(u,t),o?fa.addScaledVector(Rh,h):fa.addScaledVector(Rh.sub(e),h))}e.add(fa)}return e}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let i=this.geometry,n=this.material,r=this.matrixWorld;n!==void 0&&(i.boundingSphere===null&&i.computeBoundingSphere(),ca.copy(i.boundingSphere),ca.applyMatrix4(r),Hn.copy(t.ray).recast(t.near),!(ca.containsPoint(Hn.origin)===!1&&(Hn.intersectSphere(ca,wf)===null||Hn.origin.distanceToSquared(wf)>(t.far-t.near)**2))&&(Sf.copy(r).invert(),Hn.copy(t.ray).applyMatrix4(Sf),!(i.boundingBox!==null&&Hn.intersectsBox(i.boundingBox)===!1)&&this._computeIntersections(t,e,Hn)))}_computeIntersections(t,e,i){let n,r=this.geometry,o=this.material,a=r.index,l=r.attributes.position,c=r.attributes.uv,h=r.attributes.uv1,u=r.attributes.normal,d=r.groups,f=r.drawRange;if(a!==null)if(Array.isArray(o))for(let p=0,_=d.length;p<_;p++){let m=d[p],g=o[m.materialIndex],b=Math.max(m.start,f.start),E=Math.min(a.count,Math.min(m.start+m.count,f.start+f.count));for(let M=b,T=E;M<T;M+=3){let A=a.getX(M),x=a.getX(M+1),S=a.getX(M+2);n=ma(this,g,t,i,c,h,u,A,x,S),n&&(n.faceIndex=Math.floor(M/3),n.face.materialIndex=m.materialIndex,e.push(n))}}else{let p=Math.max(0,f.start),_=Math.min(a.count,f.start+f.count);for(let m=p,g=_;m<g;m+=3){let b=a.getX(m),E=a.getX(m+1),M=a.getX(m+2);n=ma(this,o,t,i,c,h,u,b,E,M),n&&(n.faceIndex=Math.floor(m/3),e.push(n))}}else if(l!==void 0)if(Array.isArray(o))for(let p=0,_=d.length;p<_;p++){let m=d[p],g=o[m.materialIndex],b=Math.max(m.start,f.start),E=Math.min(l.count,Math.min(m.start+m.count,f.start+f.count));for(let M=b,T=E;M<T;M+=3){let A=M,x=M+1,S=M+2;n=ma(this,g,t,i,c,h,u,A,x,S),n&&(n.faceIndex=Math.floor(M/3),n.face.materialIndex=m.materialIndex,e.push(n))}}else{let p=Math.max(0,f.start),_=Math.min(l.count,f.start+f.count);for(let m=p,g=_;m<g;m+=3){let b=m,E=m+1,M=m+2;n=ma(this,o,t,i,c,h,u,b,E,M),n&&(n.faceIndex=Math.floor(m/3),e.push(n))}}}};function ix(s,t,e,i,n,r,o,a){let l;if(t.side===ze?l=i.intersectTriangle(o,r,n,!0,a):l=i.intersectTriangle(n,r,o,t.side===Rn,a),l===null)return null;pa.copy(a),pa.applyMatrix4(s.matrixWorld);let c=e.ray.origin.distanceTo(pa);return c<e.near||c>e.far?null:{distance:c,point:pa.clone(),object:s}}function ma(s,t,e,i,n,r,o,a,l,c){s.getVertexPosition(a,ha),s.getVertexPosition(l,ua),s.getVertexPosition(c,da);let h=ix(s,t,e,i,ha,ua,da,Ef);if(h){let u=new L;yn.getBarycoord(Ef,ha,ua,da,u),n&&(h.uv=yn.getInterpolatedAttribute(n,a,l,c,u,new lt)),r&&(h.uv1=yn.getInterpolatedAttribute(r,a,l,c,u,new lt)),o&&(h.normal=yn.getInterpolatedAttribute(o,a,l,c,u,new L),h.normal.dot(i.direction)>0&&h.normal.multiplyScalar(-1));let d={a,b:l,c,normal:new L,materialIndex:0};yn.getNormal(ha,ua,da,d.normal),h.face=d,h.barycoord=u}return h}var Cr=class extends ei{constructor(t=null,e=1,i=1,n,r,o,a,l,c=Fe,h=Fe,u,d){super(null,o,a,l,c,h,n,r,u,d),this.isDataTexture=!0,this.image={data:t,width:e,height:i},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var Cs=class extends ti{constructor(t,e,i,n=1){super(t,e,i),this.isInstancedBufferAttribute=!0,this.meshPerAttribute=n}copy(t){return super.copy(t),this.meshPerAttribute=t.meshPerAttribute,this}toJSON(){let t=super.toJSON();return t.meshPerAttribute=this.meshPerAttribute,t.isInstancedBufferAttribute=!0,t}},xs=new re,Af=new re,ga=[],Tf=new ki,nx=new re,fr=new Wt,pr=new Bi,Ir=class extends Wt{constructor(t,e,i){super(t,e),this.isInstancedMesh=!0,this.instanceMatrix=new Cs(new Float32Array(i*16),16),this.instanceColor=null,this.morphTexture=null,this.count=i,this.boundingBox=null,this.boundingSphere=null;for(let n=0;n<i;n++)this.setMatrixAt(n,nx)}computeBoundingBox(){let t=this.geometry,e=this.count;this.boundingBox===null&&(this.boundingBox=new ki),t.boundingBox===null&&t.computeBoundingBox(),this.boundingBox.makeEmpty();for(let i=0;i<e;i++)this.getMatrixAt(i,xs),Tf.copy(t.boundingBox).applyMatrix4(xs),this.boundingBox.union(Tf)}computeBoundingSphere(){let t=this.geometry,e=this.count;this.boundingSphere===null&&(this.boundingSphere=new Bi),t.boundingSphere===null&&t.computeBoundingSphere(),this.boundingSphere.makeEmpty();for(let i=0;i<e;i++)this.getMatrixAt(i,xs),pr.copy(t.boundingSphere).applyMatrix4(xs),this.boundingSphere.union(pr)}copy(t,e){return super.copy(t,e),this.instanceMatrix.copy(t.instanceMatrix),this.morphTexture=t.morphTexture!==null?t.morphTexture.clone():null,this.instanceColor=t.instanceColor!==null?t.instanceColor.clone():null,this.count=t.count,this.boundingBox=t.boundingBox!==null?t.boundingBox.clone():null,this.boundingSphere=t.boundingSphere!==null?t.boundingSphere.clone():null,this}getColorAt(t,e){return this.instanceColor===null?e.setRGB(1,1,1):e.fromArray(this.instanceColor.array,t*3)}getMatrixAt(t,e){return e.fromArray(this.instanceMatrix.array,t*16)}getMorphAt(t,e){let i=e.morphTargetInfluences,n=this.morphTexture.source.data.data,r=i.length+1,o=t*r+1;for(let a=0;a<i.length;a++)i[a]=n[o+a]}raycast(t,e){let i=this.matrixWorld,n=this.count;if(fr.geometry=this.geometry,fr.material=this.material,fr.material!==void 0&&(this.boundingSphere===null&&this.computeBoundingSphere(),pr.copy(this.boundingSphere),pr.applyMatrix4(i),t.ray.intersectsSphere(pr)!==!1))for(let r=0;r<n;r++){this.getMatrixAt(r,xs),Af.multiplyMatrices(i,xs),fr.matrixWorld=Af,fr.raycast(t,ga);for(let o=0,a=ga.length;o<a;o++){let l=ga[o];l.instanceId=r,l.object=this,e.push(l)}ga.length=0}}setColorAt(t,e){return this.instanceColor===null&&(this.instanceColor=new Cs(new Float32Array(this.instanceMatrix.count*3).fill(1),3)),e.toArray(this.instanceColor.array,t*3),this}setMatrixAt(t,e){return e.toArray(this.instanceMatrix.array,t*16),this}setMorphAt(t,e){let i=e.morphTargetInfluences,n=i.length+1;this.morphTexture===null&&(this.morphTexture=new Cr(new Float32Array(n*this.count),n,this.count,Ml,xi));let r=this.morphTexture.source.data.data,o=0;for(let c=0;c<i.length;c++)o+=i[c];let a=this.geometry.morphTargetsRelative?1:1-o,l=n*t;return r[l]=a,r.set(i,l+1),this}updateMorphTargets(){}dispose(){super.dispose(),this.instanceMatrix.dispose(),this.instanceColor!==null&&this.instanceColor.dispose(),this.morphTexture!==null&&(this.morphTexture.dispose(),this.morphTexture=null)}},Wn=new Bi,sx=new lt(.5,.5),xa=new L,bn=class{constructor(t=new Ei,e=new Ei,i=new Ei,n=new Ei,r=new Ei,o=new Ei){this.planes=[t,e,i,n,r,o]}set(t,e,i,n,r,o){let a=this.planes;return a[0].copy(t),a[1].copy(e),a[2].copy(i),a[3].copy(n),a[4].copy(r),a[5].copy(o),this}copy(t){let e=this.planes;for(let i=0;i<6;i++)e[i].copy(t.planes[i]);return this}setFromProjectionMatrix(t,e=pi,i=!1){let n=this.planes,r=t.elements,o=r[0],a=r[1],l=r[2],c=r[3],h=r[4],u=r[5],d=r[6],f=r[7],p=r[8],_=r[9],m=r[10],g=r[11],b=r[12],E=r[13],M=r[14],T=r[15];if(n[0].setComponents(c-o,f-h,g-p,T-b).normalize(),n[1].setComponents(c+o,f+h,g+p,T+b).normalize(),n[2].setComponents(c+a,f+u,g+_,T+E).normalize(),n[3].setComponents(c-a,f-u,g-_,T-E).normalize(),i)n[4].setComponents(l,d,m,M).normalize(),n[5].setComponents(c-l,f-d,g-m,T-M).normalize();else if(n[4].setComponents(c-l,f-d,g-m,T-M).normalize(),e===pi)n[5].setComponents(c+l,f+d,g+m,T+M).normalize();else if(e===Ss)n[5].setComponents(l,d,m,M).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+e);return this}intersectsObject(t){if(t.boundingSphere!==void 0)t.boundingSphere===null&&t.computeBoundingSphere(),Wn.copy(t.boundingSphere).applyMatrix4(t.matrixWorld);else{let e=t.geometry;e.boundingSphere===null&&e.computeBoundingSphere(),Wn.copy(e.boundingSphere).applyMatrix4(t.matrixWorld)}return this.intersectsSphere(Wn)}intersectsSprite(t){Wn.center.set(0,0,0);let e=sx.distanceTo(t.center);return Wn.radius=.7071067811865476+e,Wn.applyMatrix4(t.matrixWorld),this.intersectsSphere(Wn)}intersectsSphere(t){let e=this.planes,i=t.center,n=-t.radius;for(let r=0;r<6;r++)if(e[r].distanceToPoint(i)<n)return!1;return!0}intersectsBox(t){let e=this.planes;for(let i=0;i<6;i++){let n=e[i];if(xa.x=n.normal.x>0?t.max.x:t.min.x,xa.y=n.normal.y>0?t.max.y:t.min.y,xa.z=n.normal.z>0?t.max.z:t.min.z,n.distanceToPoint(xa)<0)return!1}return!0}containsPoint(t){let e=this.planes;for(let i=0;i<6;i++)if(e[i].distanceToPoint(t)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},Rf=new re,Ha=class s{constructor(){this.coordinateSystem=pi,this._frustums=[],this._count=0}setFromArrayCamera(t){let e=t.cameras,i=this._frustums;for(let n=0;n<e.length;n++){let r=e[n];Rf.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),i[n]===void 0&&(i[n]=new bn),i[n].setFromProjectionMatrix(Rf,r.coordinateSystem,r.reversedDepth)}return this._count=e.length,this}getFrustum(t){return this._frustums[t]}intersectsObject(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsObject(t))return!0;return!1}intersectsSprite(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsSprite(t))return!0;return!1}intersectsSphere(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsSphere(t))return!0;return!1}intersectsBox(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsBox(t))return!0;return!1}containsPoint(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].containsPoint(t))return!0;return!1}copy(t){this.coordinateSystem=t.coordinateSystem;let e=this._frustums,i=t._frustums;for(let n=0;n<t._count;n++)e[n]===void 0&&(e[n]=new bn),e[n].copy(i[n]);return this._count=t._count,this}clone(){return new s().copy(this)}};var Is=class extends gi{constructor(t){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new Ct(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.linewidth=t.linewidth,this.linecap=t.linecap,this.linejoin=t.linejoin,this.fog=t.fog,this}},Wa=new L,Xa=new L,Cf=new re,mr=new $n,_a=new Bi,Ch=new L,If=new L,qa=class extends Ce{constructor(t=new _e,e=new Is){super(),this.isLine=!0,this.type="Line",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}computeLineDistances(){let t=this.geometry;if(t.index===null){let e=t.attributes.position,i=[0];for(let n=1,r=e.count;n<r;n++)Wa.fromBufferAttribute(e,n-1),Xa.fromBufferAttribute(e,n),i[n]=i[n-1],i[n]+=Wa.distanceTo(Xa);t.setAttribute("lineDistance",new qt(i,1))}else kt("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let i=this.geometry,n=this.matrixWorld,r=t.params.Line.threshold,o=i.drawRange;if(i.boundingSphere===null&&i.computeBoundingSphere(),_a.copy(i.boundingSphere),_a.applyMatrix4(n),_a.radius+=r,t.ray.intersectsSphere(_a)===!1)return;Cf.copy(n).invert(),mr.copy(t.ray).applyMatrix4(Cf);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=this.isLineSegments?2:1,h=i.index,d=i.attributes.position;if(h!==null){let f=Math.max(0,o.start),p=Math.min(h.count,o.start+o.count);for(let _=f,m=p-1;_<m;_+=c){let g=h.getX(_),b=h.getX(_+1),E=va(this,t,mr,l,g,b,_);E&&e.push(E)}if(this.isLineLoop){let _=h.getX(p-1),m=h.getX(f),g=va(this,t,mr,l,_,m,p-1);g&&e.push(g)}}else{let f=Math.max(0,o.start),p=Math.min(d.count,o.start+o.count);for(let _=f,m=p-1;_<m;_+=c){let g=va(this,t,mr,l,_,_+1,_);g&&e.push(g)}if(this.isLineLoop){let _=va(this,t,mr,l,p-1,f,p-1);_&&e.push(_)}}}updateMorphTargets(){let e=this.geometry.morphAttributes,i=Object.keys(e);if(i.length>0){let n=e[i[0]];if(n!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=n.length;r<o;r++){let a=n[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function va(s,t,e,i,n,r,o){let a=s.geometry.attributes.position;if(Wa.fromBufferAttribute(a,n),Xa.fromBufferAttribute(a,r),e.distanceSqToSegment(Wa,Xa,Ch,If)>i)return;Ch.applyMatrix4(s.matrixWorld);let c=t.ray.origin.distanceTo(Ch);if(!(c<t.near||c>t.far))return{distance:c,point:If.clone().applyMatrix4(s.matrixWorld),index:o,face:null,faceIndex:null,barycoord:null,object:s}}var Pr=class extends qa{constructor(t,e){super(t,e),this.isLineLoop=!0,this.type="LineLoop"}},$a=class extends gi{constructor(t){super(),this.isPointsMaterial=!0,this.type="PointsMaterial",this.color=new Ct(16777215),this.map=null,this.alphaMap=null,this.size=1,this.sizeAttenuation=!0,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.alphaMap=t.alphaMap,this.size=t.size,this.sizeAttenuation=t.sizeAttenuation,this.fog=t.fog,this}},Pf=new re,kh=new $n,ya=new Bi,ba=new L,Lr=class extends Ce{constructor(t=new _e,e=new $a){super(),this.isPoints=!0,this.type="Points",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let i=this.geometry,n=this.matrixWorld,r=t.params.Points.threshold,o=i.drawRange;if(i.boundingSphere===null&&i.computeBoundingSphere(),ya.copy(i.boundingSphere),ya.applyMatrix4(n),ya.radius+=r,t.ray.intersectsSphere(ya)===!1)return;Pf.copy(n).invert(),kh.copy(t.ray).applyMatrix4(Pf);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=i.index,u=i.attributes.position;if(c!==null){let d=Math.max(0,o.start),f=Math.min(c.count,o.start+o.count);for(let p=d,_=f;p<_;p++){let m=c.getX(p);ba.fromBufferAttribute(u,m),Lf(ba,m,l,n,t,e,this)}}else{let d=Math.max(0,o.start),f=Math.min(u.count,o.start+o.count);for(let p=d,_=f;p<_;p++)ba.fromBufferAttribute(u,p),Lf(ba,p,l,n,t,e,this)}}updateMorphTargets(){let e=this.geometry.morphAttributes,i=Object.keys(e);if(i.length>0){let n=e[i[0]];if(n!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=n.length;r<o;r++){let a=n[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function Lf(s,t,e,i,n,r,o){let a=kh.distanceSqToPoint(s);if(a<e){let l=new L;kh.closestPointToPoint(s,l),l.applyMatrix4(i);let c=n.ray.origin.distanceTo(l);if(c<n.near||c>n.far)return;r.push({distance:c,distanceToRay:Math.sqrt(a),point:l,index:t,face:null,faceIndex:null,barycoord:null,object:o})}}var Nr=class extends ei{constructor(t=[],e=Qn,i,n,r,o,a,l,c,h){super(t,e,i,n,r,o,a,l,c,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(t){this.image=t}};var nn=class extends ei{constructor(t,e,i=Ti,n,r,o,a=Fe,l=Fe,c,h=en,u=1){if(h!==en&&h!==on)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let d={width:t,height:e,depth:u};super(d,n,r,o,a,l,h,i,c),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(t){return super.copy(t),this.source=new Es(Object.assign({},t.image)),this.compareFunction=t.compareFunction,this}toJSON(t){let e=super.toJSON(t);return e.compareFunction=this.compareFunction,e}},Dr=class extends nn{constructor(t,e=Ti,i=Qn,n,r,o=Fe,a=Fe,l,c=en){let h={width:t,height:t,depth:1},u=[h,h,h,h,h,h];super(t,t,e,i,n,r,o,a,l,c),this.image=u,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(t){this.image=t}},Ur=class extends ei{constructor(t=null){super(),this.sourceTexture=t,this.isExternalTexture=!0}copy(t){return super.copy(t),this.sourceTexture=t.sourceTexture,this}},zi=class s extends _e{constructor(t=1,e=1,i=1,n=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:t,height:e,depth:i,widthSegments:n,heightSegments:r,depthSegments:o};let a=this;n=Math.floor(n),r=Math.floor(r),o=Math.floor(o);let l=[],c=[],h=[],u=[],d=0,f=0;p("z","y","x",-1,-1,i,e,t,o,r,0),p("z","y","x",1,-1,i,e,-t,o,r,1),p("x","z","y",1,1,t,i,e,n,o,2),p("x","z","y",1,-1,t,i,-e,n,o,3),p("x","y","z",1,-1,t,e,i,n,r,4),p("x","y","z",-1,-1,t,e,-i,n,r,5),this.setIndex(l),this.setAttribute("position",new qt(c,3)),this.setAttribute("normal",new qt(h,3)),this.setAttribute("uv",new qt(u,2));function p(_,m,g,b,E,M,T,A,x,S,U){let I=M/x,D=T/S,F=M/2,H=T/2,C=A/2,z=x+1,X=S+1,G=0,et=0,W=new L;for(let K=0;K<X;K++){let tt=K*D-H;for(let St=0;St<z;St++){let Ot=St*I-F;W[_]=Ot*b,W[m]=tt*E,W[g]=C,c.push(W.x,W.y,W.z),W[_]=0,W[m]=0,W[g]=A>0?1:-1,h.push(W.x,W.y,W.z),u.push(St/x),u.push(1-K/S),G+=1}}for(let K=0;K<S;K++)for(let tt=0;tt<x;tt++){let St=d+tt+z*K,Ot=d+tt+z*(K+1),$=d+(tt+1)+z*(K+1),xt=d+(tt+1)+z*K;l.push(St,Ot,xt),l.push(Ot,$,xt),et+=6}a.addGroup(f,et,U),f+=et,d+=G}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new s(t.width,t.height,t.depth,t.widthSegments,t.heightSegments,t.depthSegments)}};var Or=class s extends _e{constructor(t=1,e=32,i=0,n=Math.PI*2){super(),this.type="CircleGeometry",this.parameters={radius:t,segments:e,thetaStart:i,thetaLength:n},e=Math.max(3,e);let r=[],o=[],a=[],l=[],c=new L,h=new lt;o.push(0,0,0),a.push(0,0,1),l.push(.5,.5);for(let u=0,d=3;u<=e;u++,d+=3){let f=i+u/e*n;c.x=t*Math.cos(f),c.y=t*Math.sin(f),o.push(c.x,c.y,c.z),a.push(0,0,1),h.x=(o[d]/t+1)/2,h.y=(o[d+1]/t+1)/2,l.push(h.x,h.y)}for(let u=1;u<=e;u++)r.push(u,u+1,0);this.setIndex(r),this.setAttribute("position",new qt(o,3)),this.setAttribute("normal",new qt(a,3)),this.setAttribute("uv",new qt(l,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new s(t.radius,t.segments,t.thetaStart,t.thetaLength)}},je=class s extends _e{constructor(t=1,e=1,i=1,n=32,r=1,o=!1,a=0,l=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:t,radiusBottom:e,height:i,radialSegments:n,heightSegments:r,openEnded:o,thetaStart:a,thetaLength:l};let c=this;n=Math.floor(n),r=Math.floor(r);let h=[],u=[],d=[],f=[],p=0,_=[],m=i/2,g=0;b(),o===!1&&(t>0&&E(!0),e>0&&E(!1)),this.setIndex(h),this.setAttribute("position",new qt(u,3)),this.setAttribute("normal",new qt(d,3)),this.setAttribute("uv",new qt(f,2));function b(){let M=new L,T=new L,A=0,x=(e-t)/i;for(let S=0;S<=r;S++){let U=[],I=S/r,D=I*(e-t)+t;for(let F=0;F<=n;F++){let H=F/n,C=H*l+a,z=Math.sin(C),X=Math.cos(C);T.x=D*z,T.y=-I*i+m,T.z=D*X,u.push(T.x,T.y,T.z),M.set(z,x,X).normalize(),d.push(M.x,M.y,M.z),f.push(H,1-I),U.push(p++)}_.push(U)}for(let S=0;S<n;S++)for(let U=0;U<r;U++){let I=_[U][S],D=_[U+1][S],F=_[U+1][S+1],H=_[U][S+1];(t>0||U!==0)&&(h.push(I,D,H),A+=3),(e>0||U!==r-1)&&(h.push(D,F,H),A+=3)}c.addGroup(g,A,0),g+=A}function E(M){let T=p,A=new lt,x=new L,S=0,U=M===!0?t:e,I=M===!0?1:-1;for(let F=1;F<=n;F++)u.push(0,m*I,0),d.push(0,I,0),f.push(.5,.5),p++;let D=p;for(let F=0;F<=n;F++){let C=F/n*l+a,z=Math.cos(C),X=Math.sin(C);x.x=U*X,x.y=m*I,x.z=U*z,u.push(x.x,x.y,x.z),d.push(0,I,0),A.x=z*.5+.5,A.y=X*.5*I+.5,f.push(A.x,A.y),p++}for(let F=0;F<n;F++){let H=T+F,C=D+F;M===!0?h.push(C,C+1,H):h.push(C+1,C,H),S+=3}c.addGroup(g,S,M===!0?1:2),g+=S}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new s(t.radiusTop,t.radiusBottom,t.height,t.radialSegments,t.heightSegments,t.openEnded,t.thetaStart,t.thetaLength)}},Fr=class s extends je{constructor(t=1,e=1,i=32,n=1,r=!1,o=0,a=Math.PI*2){super(0,t,e,i,n,r,o,a),this.type="ConeGeometry",this.parameters={radius:t,height:e,radialSegments:i,heightSegments:n,openEnded:r,thetaStart:o,thetaLength:a}}static fromJSON(t){return new s(t.radius,t.height,t.radialSegments,t.heightSegments,t.openEnded,t.thetaStart,t.thetaLength)}};var ci=class{constructor(){this.type="Curve",this.arcLengthDivisions=200,this.needsUpdate=!1,this.cacheArcLengths=null}getPoint(){kt("Curve: .getPoint() not implemented.")}getPointAt(t,e){let i=this.getUtoTmapping(t);return this.getPoint(i,e)}getPoints(t=5){let e=[];for(let i=0;i<=t;i++)e.push(this.getPoint(i/t));return e}getSpacedPoints(t=5){let e=[];for(let i=0;i<=t;i++)e.push(this.getPointAt(i/t));return e}getLength(){let t=this.getLengths();return t[t.length-1]}getLengths(t=this.arcLengthDivisions){if(this.cacheArcLengths&&this.cacheArcLengths.length===t+1&&!this.needsUpdate)return this.cacheArcLengths;this.needsUpdate=!1;let e=[],i,n=this.getPoint(0),r=0;e.push(0);for(let o=1;o<=t;o++)i=this.getPoint(o/t),r+=i.distanceTo(n),e.push(r),n=i;return this.cacheArcLengths=e,e}updateArcLengths(){this.needsUpdate=!0,this.getLengths()}getUtoTmapping(t,e=null){let i=this.getLengths(),n=0,r=i.length,o;e?o=e:o=t*i[r-1];let a=0,l=r-1,c;for(;a<=l;)if(n=Math.floor(a+(l-a)/2),c=i[n]-o,c<0)a=n+1;else if(c>0)l=n-1;else{l=n;break}if(n=l,i[n]===o)return n/(r-1);let h=i[n],d=i[n+1]-h,f=(o-h)/d;return(n+f)/(r-1)}getTangent(t,e){let n=t-1e-4,r=t+1e-4;n<0&&(n=0),r>1&&(r=1);let o=this.getPoint(n),a=this.getPoint(r),l=e||(o.isVector2?new lt:new L);return l.copy(a).sub(o).normalize(),l}getTangentAt(t,e){let i=this.getUtoTmapping(t);return this.getTangent(i,e)}computeFrenetFrames(t,e=!1){let i=new L,n=[],r=[],o=[],a=new L,l=new re;for(let f=0;f<=t;f++){let p=f/t;n[f]=this.getTangentAt(p,new L)}r[0]=new L,o[0]=new L;let c=Number.MAX_VALUE,h=Math.abs(n[0].x),u=Math.abs(n[0].y),d=Math.abs(n[0].z);h<=c&&(c=h,i.set(1,0,0)),u<=c&&(c=u,i.set(0,1,0)),d<=c&&i.set(0,0,1),a.crossVectors(n[0],i).normalize(),r[0].crossVectors(n[0],a),o[0].crossVectors(n[0],r[0]);for(let f=1;f<=t;f++){if(r[f]=r[f-1].clone(),o[f]=o[f-1].clone(),a.crossVectors(n[f-1],n[f]),a.length()>Number.EPSILON){a.normalize();let p=Math.acos(Qt(n[f-1].dot(n[f]),-1,1));r[f].applyMatrix4(l.makeRotationAxis(a,p))}o[f].crossVectors(n[f],r[f])}if(e===!0){let f=Math.acos(Qt(r[0].dot(r[t]),-1,1));f/=t,n[0].dot(a.crossVectors(r[0],r[t]))>0&&(f=-f);for(let p=1;p<=t;p++)r[p].applyMatrix4(l.makeRotationAxis(n[p],f*p)),o[p].crossVectors(n[p],r[p])}return{tangents:n,normals:r,binormals:o}}clone(){return new this.constructor().copy(this)}copy(t){return this.arcLengthDivisions=t.arcLengthDivisions,this.cacheArcLengths=null,this}toJSON(){let t={metadata:{version:4.7,type:"Curve",generator:"Curve.toJSON"}};return t.arcLengthDivisions=this.arcLengthDivisions,t.type=this.type,t}fromJSON(t){return this.arcLengthDivisions=t.arcLengthDivisions,this.cacheArcLengths=null,this}},Ps=class extends ci{constructor(t=0,e=0,i=1,n=1,r=0,o=Math.PI*2,a=!1,l=0){super(),this.isEllipseCurve=!0,this.type="EllipseCurve",this.aX=t,this.aY=e,this.xRadius=i,this.yRadius=n,this.aStartAngle=r,this.aEndAngle=o,this.aClockwise=a,this.aRotation=l}getPoint(t,e=new lt){let i=e,n=Math.PI*2,r=this.aEndAngle-this.aStartAngle,o=Math.abs(r)<Number.EPSILON;for(;r<0;)r+=n;for(;r>n;)r-=n;r<Number.EPSILON&&(o?r=0:r=n),this.aClockwise===!0&&!o&&(r===n?r=-n:r=r-n);let a=this.aStartAngle+t*r,l=this.aX+this.xRadius*Math.cos(a),c=this.aY+this.yRadius*Math.sin(a);if(this.aRotation!==0){let h=Math.cos(this.aRotation),u=Math.sin(this.aRotation),d=l-this.aX,f=c-this.aY;l=d*h-f*u+this.aX,c=d*u+f*h+this.aY}return i.set(l,c)}copy(t){return super.copy(t),this.aX=t.aX,this.aY=t.aY,this.xRadius=t.xRadius,this.yRadius=t.yRadius,this.aStartAngle=t.aStartAngle,this.aEndAngle=t.aEndAngle,this.aClockwise=t.aClockwise,this.aRotation=t.aRotation,this}toJSON(){let t=super.toJSON();return t.aX=this.aX,t.aY=this.aY,t.xRadius=this.xRadius,t.yRadius=this.yRadius,t.aStartAngle=this.aStartAngle,t.aEndAngle=this.aEndAngle,t.aClockwise=this.aClockwise,t.aRotation=this.aRotation,t}fromJSON(t){return super.fromJSON(t),this.aX=t.aX,this.aY=t.aY,this.xRadius=t.xRadius,this.yRadius=t.yRadius,this.aStartAngle=t.aStartAngle,this.aEndAngle=t.aEndAngle,this.aClockwise=t.aClockwise,this.aRotation=t.aRotation,this}},Ya=class extends Ps{constructor(t,e,i,n,r,o){super(t,e,i,i,n,r,o),this.isArcCurve=!0,this.type="ArcCurve"}};function vu(){let s=0,t=0,e=0,i=0;function n(r,o,a,l){s=r,t=a,e=-3*r+3*o-2*a-l,i=2*r-2*o+a+l}return{initCatmullRom:function(r,o,a,l,c){n(o,a,c*(a-r),c*(l-o))},initNonuniformCatmullRom:function(r,o,a,l,c,h,u){let d=(o-r)/c-(a-r)/(c+h)+(a-o)/h,f=(a-o)/h-(l-o)/(h+u)+(l-a)/u;d*=h,f*=h,n(o,a,d,f)},calc:function(r){let o=r*r,a=o*r;return s+t*r+e*o+i*a}}}var Nf=new L,Df=new L,Ih=new vu,Ph=new vu,Lh=new vu,Za=class extends ci{constructor(t=[],e=!1,i="centripetal",n=.5){super(),this.isCatmullRomCurve3=!0,this.type="CatmullRomCurve3",this.points=t,this.closed=e,this.curveType=i,this.tension=n}getPoint(t,e=new L){let i=e,n=this.points,r=n.length,o=(r-(this.closed?0:1))*t,a=Math.floor(o),l=o-a;this.closed?a+=a>0?0:(Math.floor(Math.abs(a)/r)+1)*r:l===0&&a===r-1&&(a=r-2,l=1);let c,h;this.closed||a>0?c=n[(a-1)%r]:(Df.subVectors(n[0],n[1]).add(n[0]),c=Df);let u=n[a%r],d=n[(a+1)%r];if(this.closed||a+2<r?h=n[(a+2)%r]:(Nf.subVectors(n[r-1],n[r-2]).add(n[r-1]),h=Nf),this.curveType==="centripetal"||this.curveType==="chordal"){let f=this.curveType==="chordal"?.5:.25,p=Math.pow(c.distanceToSquared(u),f),_=Math.pow(u.distanceToSquared(d),f),m=Math.pow(d.distanceToSquared(h),f);_<1e-4&&(_=1),p<1e-4&&(p=_),m<1e-4&&(m=_),Ih.initNonuniformCatmullRom(c.x,u.x,d.x,h.x,p,_,m),Ph.initNonuniformCatmullRom(c.y,u.y,d.y,h.y,p,_,m),Lh.initNonuniformCatmullRom(c.z,u.z,d.z,h.z,p,_,m)}else this.curveType==="catmullrom"&&(Ih.initCatmullRom(c.x,u.x,d.x,h.x,this.tension),Ph.initCatmullRom(c.y,u.y,d.y,h.y,this.tension),Lh.initCatmullRom(c.z,u.z,d.z,h.z,this.tension));return i.set(Ih.calc(l),Ph.calc(l),Lh.calc(l)),i}copy(t){super.copy(t),this.points=[];for(let e=0,i=t.points.length;e<i;e++){let n=t.points[e];this.points.push(n.clone())}return this.closed=t.closed,this.curveType=t.curveType,this.tension=t.tension,this}toJSON(){let t=super.toJSON();t.points=[];for(let e=0,i=this.points.length;e<i;e++){let n=this.points[e];t.points.push(n.toArray())}return t.closed=this.closed,t.curveType=this.curveType,t.tension=this.tension,t}fromJSON(t){super.fromJSON(t),this.points=[];for(let e=0,i=t.points.length;e<i;e++){let n=t.points[e];this.points.push(new L().fromArray(n))}return this.closed=t.closed,this.curveType=t.curveType,this.tension=t.tension,this}};function Uf(s,t,e,i,n){let r=(i-t)*.5,o=(n-e)*.5,a=s*s,l=s*a;return(2*e-2*i+r+o)*l+(-3*e+3*i-2*r-o)*a+r*s+e}function rx(s,t){let e=1-s;return e*e*t}function ox(s,t){return 2*(1-s)*s*t}function ax(s,t){return s*s*t}function _r(s,t,e,i){return rx(s,t)+ox(s,e)+ax(s,i)}function lx(s,t){let e=1-s;return e*e*e*t}function cx(s,t){let e=1-s;return 3*e*e*s*t}function hx(s,t){return 3*(1-s)*s*s*t}function ux(s,t){return s*s*s*t}function vr(s,t,e,i,n){return lx(s,t)+cx(s,e)+hx(s,i)+ux(s,n)}var kr=class extends ci{constructor(t=new lt,e=new lt,i=new lt,n=new lt){super(),this.isCubicBezierCurve=!0,this.type="CubicBezierCurve",this.v0=t,this.v1=e,this.v2=i,this.v3=n}getPoint(t,e=new lt){let i=e,n=this.v0,r=this.v1,o=this.v2,a=this.v3;return i.set(vr(t,n.x,r.x,o.x,a.x),vr(t,n.y,r.y,o.y,a.y)),i}copy(t){return super.copy(t),this.v0.copy(t.v0),this.v1.copy(t.v1),this.v2.copy(t.v2),this.v3.copy(t.v3),this}toJSON(){let t=super.toJSON();return t.v0=this.v0.toArray(),t.v1=this.v1.toArray(),t.v2=this.v2.toArray(),t.v3=this.v3.toArray(),t}fromJSON(t){return super.fromJSON(t),this.v0.fromArray(t.v0),this.v1.fromArray(t.v1),this.v2.fromArray(t.v2),this.v3.fromArray(t.v3),this}},Ja=class extends ci{constructor(t=new L,e=new L,i=new L,n=new L){super(),this.isCubicBezierCurve3=!0,this.type="CubicBezierCurve3",this.v0=t,this.v1=e,this.v2=i,this.v3=n}getPoint(t,e=new L){let i=e,n=this.v0,r=this.v1,o=this.v2,a=this.v3;return i.set(vr(t,n.x,r.x,o.x,a.x),vr(t,n.y,r.y,o.y,a.y),vr(t,n.z,r.z,o.z,a.z)),i}copy(t){return super.copy(t),this.v0.copy(t.v0),this.v1.copy(t.v1),this.v2.copy(t.v2),this.v3.copy(t.v3),this}toJSON(){let t=super.toJSON();return t.v0=this.v0.toArray(),t.v1=this.v1.toArray(),t.v2=this.v2.toArray(),t.v3=this.v3.toArray(),t}fromJSON(t){return super.fromJSON(t),this.v0.fromArray(t.v0),this.v1.fromArray(t.v1),this.v2.fromArray(t.v2),this.v3.fromArray(t.v3),this}},Br=class extends ci{constructor(t=new lt,e=new lt){super(),this.isLineCurve=!0,this.type="LineCurve",this.v1=t,this.v2=e}getPoint(t,e=new lt){let i=e;return t===1?i.copy(this.v2):(i.copy(this.v2).sub(this.v1),i.multiplyScalar(t).add(this.v1)),i}getPointAt(t,e){return this.getPoint(t,e)}getTangent(t,e=new lt){return e.subVectors(this.v2,this.v1).normalize()}getTangentAt(t,e){return this.getTangent(t,e)}copy(t){return super.copy(t),this.v1.copy(t.v1),this.v2.copy(t.v2),this}toJSON(){let t=super.toJSON();return t.v1=this.v1.toArray(),t.v2=this.v2.toArray(),t}fromJSON(t){return super.fromJSON(t),this.v1.fromArray(t.v1),this.v2.fromArray(t.v2),this}},ja=class extends ci{constructor(t=new L,e=new L){super(),this.isLineCurve3=!0,this.type="LineCurve3",this.v1=t,this.v2=e}getPoint(t,e=new L){let i=e;return t===1?i.copy(this.v2):(i.copy(this.v2).sub(this.v1),i.multiplyScalar(t).add(this.v1)),i}getPointAt(t,e){return this.getPoint(t,e)}getTangent(t,e=new L){return e.subVectors(this.v2,this.v1).normalize()}getTangentAt(t,e){return this.getTangent(t,e)}copy(t){return super.copy(t),this.v1.copy(t.v1),this.v2.copy(t.v2),this}toJSON(){let t=super.toJSON();return t.v1=this.v1.toArray(),t.v2=this.v2.toArray(),t}fromJSON(t){return super.fromJSON(t),this.v1.fromArray(t.v1),this.v2.fromArray(t.v2),this}},zr=class extends ci{constructor(t=new lt,e=new lt,i=new lt){super(),this.isQuadraticBezierCurve=!0,this.type="QuadraticBezierCurve",this.v0=t,this.v1=e,this.v2=i}getPoint(t,e=new lt){let i=e,n=this.v0,r=this.v1,o=this.v2;return i.set(_r(t,n.x,r.x,o.x),_r(t,n.y,r.y,o.y)),i}copy(t){return super.copy(t),this.v0.copy(t.v0),this.v1.copy(t.v1),this.v2.copy(t.v2),this}toJSON(){let t=super.toJSON();return t.v0=this.v0.toArray(),t.v1=this.v1.toArray(),t.v2=this.v2.toArray(),t}fromJSON(t){return super.fromJSON(t),this.v0.fromArray(t.v0),this.v1.fromArray(t.v1),this.v2.fromArray(t.v2),this}},Ka=class extends ci{constructor(t=new L,e=new L,i=new L){super(),this.isQuadraticBezierCurve3=!0,this.type="QuadraticBezierCurve3",this.v0=t,this.v1=e,this.v2=i}getPoint(t,e=new L){let i=e,n=this.v0,r=this.v1,o=this.v2;return i.set(_r(t,n.x,r.x,o.x),_r(t,n.y,r.y,o.y),_r(t,n.z,r.z,o.z)),i}copy(t){return super.copy(t),this.v0.copy(t.v0),this.v1.copy(t.v1),this.v2.copy(t.v2),this}toJSON(){let t=super.toJSON();return t.v0=this.v0.toArray(),t.v1=this.v1.toArray(),t.v2=this.v2.toArray(),t}fromJSON(t){return super.fromJSON(t),this.v0.fromArray(t.v0),this.v1.fromArray(t.v1),this.v2.fromArray(t.v2),this}},Gr=class extends ci{constructor(t=[]){super(),this.isSplineCurve=!0,this.type="SplineCurve",this.points=t}getPoint(t,e=new lt){let i=e,n=this.points,r=(n.length-1)*t,o=Math.floor(r),a=r-o,l=n[o===0?o:o-1],c=n[o],h=n[o>n.length-2?n.length-1:o+1],u=n[o>n.length-3?n.length-1:o+2];return i.set(Uf(a,l.x,c.x,h.x,u.x),Uf(a,l.y,c.y,h.y,u.y)),i}copy(t){super.copy(t),this.points=[];for(let e=0,i=t.points.length;e<i;e++){let n=t.points[e];this.points.push(n.clone())}return this}toJSON(){let t=super.toJSON();t.points=[];for(let e=0,i=this.points.length;e<i;e++){let n=this.points[e];t.points.push(n.toArray())}return t}fromJSON(t){super.fromJSON(t),this.points=[];for(let e=0,i=t.points.length;e<i;e++){let n=t.points[e];this.points.push(new lt().fromArray(n))}return this}},Bh=Object.freeze({__proto__:null,ArcCurve:Ya,CatmullRomCurve3:Za,CubicBezierCurve:kr,CubicBezierCurve3:Ja,EllipseCurve:Ps,LineCurve:Br,LineCurve3:ja,QuadraticBezierCurve:zr,QuadraticBezierCurve3:Ka,SplineCurve:Gr}),Qa=class extends ci{constructor(){super(),this.type="CurvePath",this.curves=[],this.autoClose=!1,this.cacheLengths=null}add(t){this.curves.push(t)}closePath(){let t=this.curves[0].getPoint(0),e=this.curves[this.curves.length-1].getPoint(1);if(!t.equals(e)){let i=t.isVector2===!0?"LineCurve":"LineCurve3";this.curves.push(new Bh[i](e,t))}return this}getPoint(t,e){let i=t*this.getLength(),n=this.getCurveLengths(),r=0;for(;r<n.length;){if(n[r]>=i){let o=n[r]-i,a=this.curves[r],l=a.getLength(),c=l===0?0:1-o/l;return a.getPointAt(c,e)}r++}return null}getLength(){let t=this.getCurveLengths();return t[t.length-1]}updateArcLengths(){this.needsUpdate=!0,this.cacheLengths=null,this.getCurveLengths()}getCurveLengths(){if(this.cacheLengths&&this.cacheLengths.length===this.curves.length)return this.cacheLengths;let t=[],e=0;for(let i=0,n=this.curves.length;i<n;i++)e+=this.curves[i].getLength(),t.push(e);return this.cacheLengths=t,t}getSpacedPoints(t=40){let e=[];for(let i=0;i<=t;i++)e.push(this.getPoint(i/t));return this.autoClose&&e.push(e[0]),e}getPoints(t=12){let e=[],i;for(let n=0,r=this.curves;n<r.length;n++){let o=r[n],a=o.isEllipseCurve?t*2:o.isLineCurve||o.isLineCurve3?1:o.isSplineCurve?t*o.points.length:t,l=o.getPoints(a);for(let c=0;c<l.length;c++){let h=l[c];i&&i.equals(h)||(e.push(h),i=h)}}return this.autoClose&&e.length>1&&!e[e.length-1].equals(e[0])&&e.push(e[0]),e}copy(t){super.copy(t),this.curves=[];for(let e=0,i=t.curves.length;e<i;e++){let n=t.curves[e];this.curves.push(n.clone())}return this.autoClose=t.autoClose,this.cacheLengths=null,this}toJSON(){let t=super.toJSON();t.autoClose=this.autoClose,t.curves=[];for(let e=0,i=this.curves.length;e<i;e++){let n=this.curves[e];t.curves.push(n.toJSON())}return t}fromJSON(t){super.fromJSON(t),this.autoClose=t.autoClose,this.curves=[];for(let e=0,i=t.curves.length;e<i;e++){let n=t.curves[e];this.curves.push(new Bh[n.type]().fromJSON(n))}return this.cacheLengths=null,this}},Yn=class extends Qa{constructor(t){super(),this.type="Path",this.currentPoint=new lt,t&&this.setFromPoints(t)}setFromPoints(t){this.moveTo(t[0].x,t[0].y);for(let e=1,i=t.length;e<i;e++)this.lineTo(t[e].x,t[e].y);return this}moveTo(t,e){return this.currentPoint.set(t,e),this}lineTo(t,e){let i=new Br(this.currentPoint.clone(),new lt(t,e));return this.curves.push(i),this.currentPoint.set(t,e),this}quadraticCurveTo(t,e,i,n){let r=new zr(this.currentPoint.clone(),new lt(t,e),new lt(i,n));return this.curves.push(r),this.currentPoint.set(i,n),this}bezierCurveTo(t,e,i,n,r,o){let a=new kr(this.currentPoint.clone(),new lt(t,e),new lt(i,n),new lt(r,o));return this.curves.push(a),this.currentPoint.set(r,o),this}splineThru(t){let e=[this.currentPoint.clone()].concat(t),i=new Gr(e);return this.curves.push(i),this.currentPoint.copy(t[t.length-1]),this}arc(t,e,i,n,r,o){let a=this.currentPoint.x,l=this.currentPoint.y;return this.absarc(t+a,e+l,i,n,r,o),this}absarc(t,e,i,n,r,o){return this.absellipse(t,e,i,i,n,r,o),this}ellipse(t,e,i,n,r,o,a,l){let c=this.currentPoint.x,h=this.currentPoint.y;return this.absellipse(t+c,e+h,i,n,r,o,a,l),this}absellipse(t,e,i,n,r,o,a,l){let c=new Ps(t,e,i,n,r,o,a,l);if(this.curves.length>0){let u=c.getPoint(0);u.equals(this.currentPoint)||this.lineTo(u.x,u.y)}this.curves.push(c);let h=c.getPoint(1);return this.currentPoint.copy(h),this}copy(t){return super.copy(t),this.currentPoint.copy(t.currentPoint),this}toJSON(){let t=super.toJSON();return t.currentPoint=this.currentPoint.toArray(),t}fromJSON(t){return super.fromJSON(t),this.currentPoint.fromArray(t.currentPoint),this}},Ls=class extends Yn{constructor(t){super(t),this.uuid=In(),this.type="Shape",this.holes=[]}getPointsHoles(t){let e=[];for(let i=0,n=this.holes.length;i<n;i++)e[i]=this.holes[i].getPoints(t);return e}extractPoints(t){return{shape:this.getPoints(t),holes:this.getPointsHoles(t)}}copy(t){super.copy(t),this.holes=[];for(let e=0,i=t.holes.length;e<i;e++){let n=t.holes[e];this.holes.push(n.clone())}return this}toJSON(){let t=super.toJSON();t.uuid=this.uuid,t.holes=[];for(let e=0,i=this.holes.length;e<i;e++){let n=this.holes[e];t.holes.push(n.toJSON())}return t}fromJSON(t){super.fromJSON(t),this.uuid=t.uuid,this.holes=[];for(let e=0,i=t.holes.length;e<i;e++){let n=t.holes[e];this.holes.push(new Yn().fromJSON(n))}return this}};function dx(s,t,e=2){let i=t&&t.length,n=i?t[0]*e:s.length,r=Dp(s,0,n,e,!0),o=[];if(!r||r.next===r.prev)return o;let a,l,c;if(i&&(r=xx(s,t,r,e)),s.length>80*e){a=s[0],l=s[1];let h=a,u=l;for(let d=e;d<n;d+=e){let f=s[d],p=s[d+1];f<a&&(a=f),p<l&&(l=p),f>h&&(h=f),p>u&&(u=p)}c=Math.max(h-a,u-l),c=c!==0?32767/c:0}return Vr(r,o,e,a,l,c,0),o}function Dp(s,t,e,i,n){let r;if(n===Rx(s,t,e,i)>0)for(let o=t;o<e;o+=i)r=Of(o/i|0,s[o],s[o+1],r);else for(let o=e-i;o>=t;o-=i)r=Of(o/i|0,s[o],s[o+1],r);return r&&Ns(r,r.next)&&(Wr(r),r=r.next),r}function Zn(s,t){if(!s)return s;t||(t=s);let e=s,i;do if(i=!1,!e.steiner&&(Ns(e,e.next)||xe(e.prev,e,e.next)===0)){if(Wr(e),e=t=e.prev,e===e.next)break;i=!0}else e=e.next;while(i||e!==t);return t}function Vr(s,t,e,i,n,r,o){if(!s)return;!o&&r&&Mx(s,i,n,r);let a=s;for(;s.prev!==s.next;){let l=s.prev,c=s.next;if(r?px(s,i,n,r):fx(s)){t.push(l.i,s.i,c.i),Wr(s),s=c.next,a=c.next;continue}if(s=c,s===a){o?o===1?(s=mx(Zn(s),t),Vr(s,t,e,i,n,r,2)):o===2&&gx(s,t,e,i,n,r):Vr(Zn(s),t,e,i,n,r,1);break}}}function fx(s){let t=s.prev,e=s,i=s.next;if(xe(t,e,i)>=0)return!1;let n=t.x,r=e.x,o=i.x,a=t.y,l=e.y,c=i.y,h=Math.min(n,r,o),u=Math.min(a,l,c),d=Math.max(n,r,o),f=Math.max(a,l,c),p=i.next;for(;p!==t;){if(p.x>=h&&p.x<=d&&p.y>=u&&p.y<=f&&gr(n,a,r,l,o,c,p.x,p.y)&&xe(p.prev,p,p.next)>=0)return!1;p=p.next}return!0}function px(s,t,e,i){let n=s.prev,r=s,o=s.next;if(xe(n,r,o)>=0)return!1;let a=n.x,l=r.x,c=o.x,h=n.y,u=r.y,d=o.y,f=Math.min(a,l,c),p=Math.min(h,u,d),_=Math.max(a,l,c),m=Math.max(h,u,d),g=zh(f,p,t,e,i),b=zh(_,m,t,e,i),E=s.prevZ,M=s.nextZ;for(;E&&E.z>=g&&M&&M.z<=b;){if(E.x>=f&&E.x<=_&&E.y>=p&&E.y<=m&&E!==n&&E!==o&&gr(a,h,l,u,c,d,E.x,E.y)&&xe(E.prev,E,E.next)>=0||(E=E.prevZ,M.x>=f&&M.x<=_&&M.y>=p&&M.y<=m&&M!==n&&M!==o&&gr(a,h,l,u,c,d,M.x,M.y)&&xe(M.prev,M,M.next)>=0))return!1;M=M.nextZ}for(;E&&E.z>=g;){if(E.x>=f&&E.x<=_&&E.y>=p&&E.y<=m&&E!==n&&E!==o&&gr(a,h,l,u,c,d,E.x,E.y)&&xe(E.prev,E,E.next)>=0)return!1;E=E.prevZ}for(;M&&M.z<=b;){if(M.x>=f&&M.x<=_&&M.y>=p&&M.y<=m&&M!==n&&M!==o&&gr(a,h,l,u,c,d,M.x,M.y)&&xe(M.prev,M,M.next)>=0)return!1;M=M.nextZ}return!0}function mx(s,t){let e=s;do{let i=e.prev,n=e.next.next;!Ns(i,n)&&Op(i,e,e.next,n)&&Hr(i,n)&&Hr(n,i)&&(t.push(i.i,e.i,n.i),Wr(e),Wr(e.next),e=s=n),e=e.next}while(e!==s);return Zn(e)}function gx(s,t,e,i,n,r){let o=s;do{let a=o.next.next;for(;a!==o.prev;){if(o.i!==a.i&&Ex(o,a)){let l=Fp(o,a);o=Zn(o,o.next),l=Zn(l,l.next),Vr(o,t,e,i,n,r,0),Vr(l,t,e,i,n,r,0);return}a=a.next}o=o.next}while(o!==s)}function xx(s,t,e,i){let n=[];for(let r=0,o=t.length;r<o;r++){let a=t[r]*i,l=r<o-1?t[r+1]*i:s.length,c=Dp(s,a,l,i,!1);c===c.next&&(c.steiner=!0),n.push(wx(c))}n.sort(_x);for(let r=0;r<n.length;r++)e=vx(n[r],e);return e}function _x(s,t){let e=s.x-t.x;if(e===0&&(e=s.y-t.y,e===0)){let i=(s.next.y-s.y)/(s.next.x-s.x),n=(t.next.y-t.y)/(t.next.x-t.x);e=i-n}return e}function vx(s,t){let e=yx(s,t);if(!e)return t;let i=Fp(e,s);return Zn(i,i.next),Zn(e,e.next)}function yx(s,t){let e=t,i=s.x,n=s.y,r=-1/0,o;if(Ns(s,e))return e;do{if(Ns(s,e.next))return e.next;if(n<=e.y&&n>=e.next.y&&e.next.y!==e.y){let u=e.x+(n-e.y)*(e.next.x-e.x)/(e.next.y-e.y);if(u<=i&&u>r&&(r=u,o=e.x<e.next.x?e:e.next,u===i))return o}e=e.next}while(e!==t);if(!o)return null;let a=o,l=o.x,c=o.y,h=1/0;e=o;do{if(i>=e.x&&e.x>=l&&i!==e.x&&Up(n<c?i:r,n,l,c,n<c?r:i,n,e.x,e.y)){let u=Math.abs(n-e.y)/(i-e.x);Hr(e,s)&&(u<h||u===h&&(e.x>o.x||e.x===o.x&&bx(o,e)))&&(o=e,h=u)}e=e.next}while(e!==a);return o}function bx(s,t){return xe(s.prev,s,t.prev)<0&&xe(t.next,s,s.next)<0}function Mx(s,t,e,i){let n=s;do n.z===0&&(n.z=zh(n.x,n.y,t,e,i)),n.prevZ=n.prev,n.nextZ=n.next,n=n.next;while(n!==s);n.prevZ.nextZ=null,n.prevZ=null,Sx(n)}function Sx(s){let t,e=1;do{let i=s,n;s=null;let r=null;for(t=0;i;){t++;let o=i,a=0;for(let c=0;c<e&&(a++,o=o.nextZ,!!o);c++);let l=e;for(;a>0||l>0&&o;)a!==0&&(l===0||!o||i.z<=o.z)?(n=i,i=i.nextZ,a--):(n=o,o=o.nextZ,l--),r?r.nextZ=n:s=n,n.prevZ=r,r=n;i=o}r.nextZ=null,e*=2}while(t>1);return s}function zh(s,t,e,i,n){return s=(s-e)*n|0,t=(t-i)*n|0,s=(s|s<<8)&16711935,s=(s|s<<4)&252645135,s=(s|s<<2)&858993459,s=(s|s<<1)&1431655765,t=(t|t<<8)&16711935,t=(t|t<<4)&252645135,t=(t|t<<2)&858993459,t=(t|t<<1)&1431655765,s|t<<1}function wx(s){let t=s,e=s;do(t.x<e.x||t.x===e.x&&t.y<e.y)&&(e=t),t=t.next;while(t!==s);return e}function Up(s,t,e,i,n,r,o,a){return(n-o)*(t-a)>=(s-o)*(r-a)&&(s-o)*(i-a)>=(e-o)*(t-a)&&(e-o)*(r-a)>=(n-o)*(i-a)}function gr(s,t,e,i,n,r,o,a){return!(s===o&&t===a)&&Up(s,t,e,i,n,r,o,a)}function Ex(s,t){return s.next.i!==t.i&&s.prev.i!==t.i&&!Ax(s,t)&&(Hr(s,t)&&Hr(t,s)&&Tx(s,t)&&(xe(s.prev,s,t.prev)||xe(s,t.prev,t))||Ns(s,t)&&xe(s.prev,s,s.next)>0&&xe(t.prev,t,t.next)>0)}function xe(s,t,e){return(t.y-s.y)*(e.x-t.x)-(t.x-s.x)*(e.y-t.y)}function Ns(s,t){return s.x===t.x&&s.y===t.y}function Op(s,t,e,i){let n=Sa(xe(s,t,e)),r=Sa(xe(s,t,i)),o=Sa(xe(e,i,s)),a=Sa(xe(e,i,t));return!!(n!==r&&o!==a||n===0&&Ma(s,e,t)||r===0&&Ma(s,i,t)||o===0&&Ma(e,s,i)||a===0&&Ma(e,t,i))}function Ma(s,t,e){return t.x<=Math.max(s.x,e.x)&&t.x>=Math.min(s.x,e.x)&&t.y<=Math.max(s.y,e.y)&&t.y>=Math.min(s.y,e.y)}function Sa(s){return s>0?1:s<0?-1:0}function Ax(s,t){let e=s;do{if(e.i!==s.i&&e.next.i!==s.i&&e.i!==t.i&&e.next.i!==t.i&&Op(e,e.next,s,t))return!0;e=e.next}while(e!==s);return!1}function Hr(s,t){return xe(s.prev,s,s.next)<0?xe(s,t,s.next)>=0&&xe(s,s.prev,t)>=0:xe(s,t,s.prev)<0||xe(s,s.next,t)<0}function Tx(s,t){let e=s,i=!1,n=(s.x+t.x)/2,r=(s.y+t.y)/2;do e.y>r!=e.next.y>r&&e.next.y!==e.y&&n<(e.next.x-e.x)*(r-e.y)/(e.next.y-e.y)+e.x&&(i=!i),e=e.next;while(e!==s);return i}function Fp(s,t){let e=Gh(s.i,s.x,s.y),i=Gh(t.i,t.x,t.y),n=s.next,r=t.prev;return s.next=t,t.prev=s,e.next=n,n.prev=e,i.next=e,e.prev=i,r.next=i,i.prev=r,i}function Of(s,t,e,i){let n=Gh(s,t,e);return i?(n.next=i.next,n.prev=i,i.next.prev=n,i.next=n):(n.prev=n,n.next=n),n}function Wr(s){s.next.prev=s.prev,s.prev.next=s.next,s.prevZ&&(s.prevZ.nextZ=s.nextZ),s.nextZ&&(s.nextZ.prevZ=s.prevZ)}function Gh(s,t,e){return{i:s,x:t,y:e,prev:null,next:null,z:0,prevZ:null,nextZ:null,steiner:!1}}function Rx(s,t,e,i){let n=0;for(let r=t,o=e-i;r<e;r+=i)n+=(s[o]-s[r])*(s[r+1]+s[o+1]),o=r;return n}var Vh=class{static triangulate(t,e,i=2){return dx(t,e,i)}},Xn=class s{static area(t){let e=t.length,i=0;for(let n=e-1,r=0;r<e;n=r++)i+=t[n].x*t[r].y-t[r].x*t[n].y;return i*.5}static isClockWise(t){return s.area(t)<0}static triangulateShape(t,e){let i=[],n=[],r=[];Ff(t),kf(i,t);let o=t.length;e.forEach(Ff);for(let l=0;l<e.length;l++)n.push(o),o+=e[l].length,kf(i,e[l]);let a=Vh.triangulate(i,n);for(let l=0;l<a.length;l+=3)r.push(a.slice(l,l+3));return r}};function Ff(s){let t=s.length;t>2&&s[t-1].equals(s[0])&&s.pop()}function kf(s,t){for(let e=0;e<t.length;e++)s.push(t[e].x),s.push(t[e].y)}var Xr=class s extends _e{constructor(t=new Ls([new lt(.5,.5),new lt(-.5,.5),new lt(-.5,-.5),new lt(.5,-.5)]),e={}){super(),this.type="ExtrudeGeometry",this.parameters={shapes:t,options:e},t=Array.isArray(t)?t:[t];let i=this,n=[],r=[];for(let a=0,l=t.length;a<l;a++){let c=t[a];o(c)}this.setAttribute("position",new qt(n,3)),this.setAttribute("uv",new qt(r,2)),this.computeVertexNormals();function o(a){let l=[],c=e.curveSegments!==void 0?e.curveSegments:12,h=e.steps!==void 0?e.steps:1,u=e.depth!==void 0?e.depth:1,d=e.bevelEnabled!==void 0?e.bevelEnabled:!0,f=e.bevelThickness!==void 0?e.bevelThickness:.2,p=e.bevelSize!==void 0?e.bevelSize:f-.1,_=e.bevelOffset!==void 0?e.bevelOffset:0,m=e.bevelSegments!==void 0?e.bevelSegments:3,g=e.extrudePath,b=e.UVGenerator!==void 0?e.UVGenerator:Cx,E,M=!1,T,A,x,S;if(g){E=g.getSpacedPoints(h),M=!0,d=!1;let Q=g.isCatmullRomCurve3?g.closed:!1;T=g.computeFrenetFrames(h,Q),A=new L,x=new L,S=new L}d||(m=0,f=0,p=0,_=0);let U=a.extractPoints(c),I=U.shape,D=U.holes;if(!Xn.isClockWise(I)){I=I.reverse();for(let Q=0,ct=D.length;Q<ct;Q++){let rt=D[Q];Xn.isClockWise(rt)&&(D[Q]=rt.reverse())}}function H(Q){let rt=10000000000000001e-36,Mt=Q[0];for(let gt=1;gt<=Q.length;gt++){let Ht=gt%Q.length,It=Q[Ht],Kt=It.x-Mt.x,te=It.y-Mt.y,oe=Kt*Kt+te*te,N=Math.max(Math.abs(It.x),Math.abs(It.y),Math.abs(Mt.x),Math.abs(Mt.y)),Ee=rt*N*N;if(oe<=Ee){Q.splice(Ht,1),gt--;continue}Mt=It}}H(I),D.forEach(H);let C=D.length,z=I;for(let Q=0;Q<C;Q++){let ct=D[Q];I=I.concat(ct)}function X(Q,ct,rt){return ct||Bt("ExtrudeGeometry: vec does not exist"),Q.clone().addScaledVector(ct,rt)}let G=I.length;function et(Q,ct,rt){let Mt,gt,Ht,It=Q.x-ct.x,Kt=Q.y-ct.y,te=rt.x-Q.x,oe=rt.y-Q.y,N=It*It+Kt*Kt,Ee=It*oe-Kt*te;if(Math.abs(Ee)>Number.EPSILON){let Jt=Math.sqrt(N),he=Math.sqrt(te*te+oe*oe),ft=ct.x-Kt/Jt,ve=ct.y+It/Jt,Ut=rt.x-oe/he,zt=rt.y+te/he,w=((Ut-ft)*oe-(zt-ve)*te)/(It*oe-Kt*te);Mt=ft+It*w-Q.x,gt=ve+Kt*w-Q.y;let v=Mt*Mt+gt*gt;if(v<=2)return new lt(Mt,gt);Ht=Math.sqrt(v/2)}else{let Jt=!1;It>Number.EPSILON?te>Number.EPSILON&&(Jt=!0):It<-Number.EPSILON?te<-Number.EPSILON&&(Jt=!0):Math.sign(Kt)===Math.sign(oe)&&(Jt=!0),Jt?(Mt=-Kt,gt=It,Ht=Math.sqrt(N)):(Mt=It,gt=Kt,Ht=Math.sqrt(N/2))}return new lt(Mt/Ht,gt/Ht)}let W=[];for(let Q=0,ct=z.length,rt=ct-1,Mt=Q+1;Q<ct;Q++,rt++,Mt++)rt===ct&&(rt=0),Mt===ct&&(Mt=0),W[Q]=et(z[Q],z[rt],z[Mt]);let K=[],tt,St=W.concat();for(let Q=0,ct=C;Q<ct;Q++){let rt=D[Q];tt=[];for(let Mt=0,gt=rt.length,Ht=gt-1,It=Mt+1;Mt<gt;Mt++,Ht++,It++)Ht===gt&&(Ht=0),It===gt&&(It=0),tt[Mt]=et(rt[Mt],rt[Ht],rt[It]);K.push(tt),St=St.concat(tt)}let Ot;if(m===0)Ot=Xn.triangulateShape(z,D);else{let Q=[],ct=[];for(let rt=0;rt<m;rt++){let Mt=rt/m,gt=f*Math.cos(Mt*Math.PI/2),Ht=p*Math.sin(Mt*Math.PI/2)+_;for(let It=0,Kt=z.length;It<Kt;It++){let te=X(z[It],W[It],Ht);Dt(te.x,te.y,-gt),Mt===0&&Q.push(te)}for(let It=0,Kt=C;It<Kt;It++){let te=D[It];tt=K[It];let oe=[];for(let N=0,Ee=te.length;N<Ee;N++){let Jt=X(te[N],tt[N],Ht);Dt(Jt.x,Jt.y,-gt),Mt===0&&oe.push(Jt)}Mt===0&&ct.push(oe)}}Ot=Xn.triangulateShape(Q,ct)}let $=Ot.length,xt=p+_;for(let Q=0;Q<G;Q++){let ct=d?X(I[Q],St[Q],xt):I[Q];M?(x.copy(T.normals[0]).multiplyScalar(ct.x),A.copy(T.binormals[0]).multiplyScalar(ct.y),S.copy(E[0]).add(x).add(A),Dt(S.x,S.y,S.z)):Dt(ct.x,ct.y,0)}for(let Q=1;Q<=h;Q++)for(let ct=0;ct<G;ct++){let rt=d?X(I[ct],St[ct],xt):I[ct];M?(x.copy(T.normals[Q]).multiplyScalar(rt.x),A.copy(T.binormals[Q]).multiplyScalar(rt.y),S.copy(E[Q]).add(x).add(A),Dt(S.x,S.y,S.z)):Dt(rt.x,rt.y,u/h*Q)}for(let Q=m-1;Q>=0;Q--){let ct=Q/m,rt=f*Math.cos(ct*Math.PI/2),Mt=p*Math.sin(ct*Math.PI/2)+_;for(let gt=0,Ht=z.length;gt<Ht;gt++){let It=X(z[gt],W[gt],Mt);Dt(It.x,It.y,u+rt)}for(let gt=0,Ht=D.length;gt<Ht;gt++){let It=D[gt];tt=K[gt];for(let Kt=0,te=It.length;Kt<te;Kt++){let oe=X(It[Kt],tt[Kt],Mt);M?Dt(oe.x,oe.y+E[h-1].y,E[h-1].x+rt):Dt(oe.x,oe.y,u+rt)}}}wt(),Nt();function wt(){let Q=n.length/3;if(d){let ct=0,rt=G*ct;for(let Mt=0;Mt<$;Mt++){let gt=Ot[Mt];pe(gt[2]+rt,gt[1]+rt,gt[0]+rt)}ct=h+m*2,rt=G*ct;for(let Mt=0;Mt<$;Mt++){let gt=Ot[Mt];pe(gt[0]+rt,gt[1]+rt,gt[2]+rt)}}else{for(let ct=0;ct<$;ct++){let rt=Ot[ct];pe(rt[2],rt[1],rt[0])}for(let ct=0;ct<$;ct++){let rt=Ot[ct];pe(rt[0]+G*h,rt[1]+G*h,rt[2]+G*h)}}i.addGroup(Q,n.length/3-Q,0)}function Nt(){let Q=n.length/3,ct=0;_t(z,ct),ct+=z.length;for(let rt=0,Mt=D.length;rt<Mt;rt++){let gt=D[rt];_t(gt,ct),ct+=gt.length}i.addGroup(Q,n.length/3-Q,1)}function _t(Q,ct){let rt=Q.length;for(;--rt>=0;){let Mt=rt,gt=rt-1;gt<0&&(gt=Q.length-1);for(let Ht=0,It=h+m*2;Ht<It;Ht++){let Kt=G*Ht,te=G*(Ht+1),oe=ct+Mt+Kt,N=ct+gt+Kt,Ee=ct+gt+te,Jt=ct+Mt+te;Ft(oe,N,Ee,Jt)}}}function Dt(Q,ct,rt){l.push(Q),l.push(ct),l.push(rt)}function pe(Q,ct,rt){Zt(Q),Zt(ct),Zt(rt);let Mt=n.length/3,gt=b.generateTopUV(i,n,Mt-3,Mt-2,Mt-1);jt(gt[0]),jt(gt[1]),jt(gt[2])}function Ft(Q,ct,rt,Mt){Zt(Q),Zt(ct),Zt(Mt),Zt(ct),Zt(rt),Zt(Mt);let gt=n.length/3,Ht=b.generateSideWallUV(i,n,gt-6,gt-3,gt-2,gt-1);jt(Ht[0]),jt(Ht[1]),jt(Ht[3]),jt(Ht[1]),jt(Ht[2]),jt(Ht[3])}function Zt(Q){n.push(l[Q*3+0]),n.push(l[Q*3+1]),n.push(l[Q*3+2])}function jt(Q){r.push(Q.x),r.push(Q.y)}}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}toJSON(){let t=super.toJSON(),e=this.parameters.shapes,i=this.parameters.options;return Ix(e,i,t)}static fromJSON(t,e){let i=[];for(let r=0,o=t.shapes.length;r<o;r++){let a=e[t.shapes[r]];i.push(a)}let n=t.options.extrudePath;return n!==void 0&&(t.options.extrudePath=new Bh[n.type]().fromJSON(n)),new s(i,t.options)}},Cx={generateTopUV:function(s,t,e,i,n){let r=t[e*3],o=t[e*3+1],a=t[i*3],l=t[i*3+1],c=t[n*3],h=t[n*3+1];return[new lt(r,o),new lt(a,l),new lt(c,h)]},generateSideWallUV:function(s,t,e,i,n,r){let o=t[e*3],a=t[e*3+1],l=t[e*3+2],c=t[i*3],h=t[i*3+1],u=t[i*3+2],d=t[n*3],f=t[n*3+1],p=t[n*3+2],_=t[r*3],m=t[r*3+1],g=t[r*3+2];return Math.abs(a-h)<Math.abs(o-c)?[new lt(o,1-l),new lt(c,1-u),new lt(d,1-p),new lt(_,1-g)]:[new lt(a,1-l),new lt(h,1-u),new lt(f,1-p),new lt(m,1-g)]}};function Ix(s,t,e){if(e.shapes=[],Array.isArray(s))for(let i=0,n=s.length;i<n;i++){let r=s[i];e.shapes.push(r.uuid)}else e.shapes.push(s.uuid);return e.options=Object.assign({},t),t.extrudePath!==void 0&&(e.options.extrudePath=t.extrudePath.toJSON()),e}var Mn=class s extends _e{constructor(t=1,e=1,i=1,n=1){super(),this.type="PlaneGeometry",this.parameters={width:t,height:e,widthSegments:i,heightSegments:n};let r=t/2,o=e/2,a=Math.floor(i),l=Math.floor(n),c=a+1,h=l+1,u=t/a,d=e/l,f=[],p=[],_=[],m=[];for(let g=0;g<h;g++){let b=g*d-o;for(let E=0;E<c;E++){let M=E*u-r;p.push(M,-b,0),_.push(0,0,1),m.push(E/a),m.push(1-g/l)}}for(let g=0;g<l;g++)for(let b=0;b<a;b++){let E=b+c*g,M=b+c*(g+1),T=b+1+c*(g+1),A=b+1+c*g;f.push(E,M,A),f.push(M,T,A)}this.setIndex(f),this.setAttribute("position",new qt(p,3)),this.setAttribute("normal",new qt(_,3)),this.setAttribute("uv",new qt(m,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new s(t.width,t.height,t.widthSegments,t.heightSegments)}},qr=class s extends _e{constructor(t=.5,e=1,i=32,n=1,r=0,o=Math.PI*2){super(),this.type="RingGeometry",this.parameters={innerRadius:t,outerRadius:e,thetaSegments:i,phiSegments:n,thetaStart:r,thetaLength:o},i=Math.max(3,i),n=Math.max(1,n);let a=[],l=[],c=[],h=[],u=t,d=(e-t)/n,f=new L,p=new lt;for(let _=0;_<=n;_++){for(let m=0;m<=i;m++){let g=r+m/i*o;f.x=u*Math.cos(g),f.y=u*Math.sin(g),l.push(f.x,f.y,f.z),c.push(0,0,1),p.x=(f.x/e+1)/2,p.y=(f.y/e+1)/2,h.push(p.x,p.y)}u+=d}for(let _=0;_<n;_++){let m=_*(i+1);for(let g=0;g<i;g++){let b=g+m,E=b,M=b+i+1,T=b+i+2,A=b+1;a.push(E,M,A),a.push(M,T,A)}}this.setIndex(a),this.setAttribute("position",new qt(l,3)),this.setAttribute("normal",new qt(c,3)),this.setAttribute("uv",new qt(h,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new s(t.innerRadius,t.outerRadius,t.thetaSegments,t.phiSegments,t.thetaStart,t.thetaLength)}};var Sn=class s extends _e{constructor(t=1,e=32,i=16,n=0,r=Math.PI*2,o=0,a=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:t,widthSegments:e,heightSegments:i,phiStart:n,phiLength:r,thetaStart:o,thetaLength:a},e=Math.max(3,Math.floor(e)),i=Math.max(2,Math.floor(i));let l=Math.min(o+a,Math.PI),c=0,h=[],u=new L,d=new L,f=[],p=[],_=[],m=[];for(let g=0;g<=i;g++){let b=[],E=g/i,M=o+E*a,T=t*Math.cos(M),A=Math.sqrt(t*t-T*T),x=0;g===0&&o===0?x=.5/e:g===i&&l===Math.PI&&(x=-.5/e);for(let S=0;S<=e;S++){let U=S/e,I=n+U*r;u.x=-A*Math.cos(I),u.y=T,u.z=A*Math.sin(I),p.push(u.x,u.y,u.z),d.copy(u).normalize(),_.push(d.x,d.y,d.z),m.push(U+x,1-E),b.push(c++)}h.push(b)}for(let g=0;g<i;g++)for(let b=0;b<e;b++){let E=h[g][b+1],M=h[g][b],T=h[g+1][b],A=h[g+1][b+1];(g!==0||o>0)&&f.push(E,M,A),(g!==i-1||l<Math.PI)&&f.push(M,T,A)}this.setIndex(f),this.setAttribute("position",new qt(p,3)),this.setAttribute("normal",new qt(_,3)),this.setAttribute("uv",new qt(m,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new s(t.radius,t.widthSegments,t.heightSegments,t.phiStart,t.phiLength,t.thetaStart,t.thetaLength)}};var sn=class s extends _e{constructor(t=1,e=.4,i=12,n=48,r=Math.PI*2,o=0,a=Math.PI*2){super(),this.type="TorusGeometry",this.parameters={radius:t,tube:e,radialSegments:i,tubularSegments:n,arc:r,thetaStart:o,thetaLength:a},i=Math.floor(i),n=Math.floor(n);let l=[],c=[],h=[],u=[],d=new L,f=new L,p=new L;for(let _=0;_<=i;_++){let m=o+_/i*a;for(let g=0;g<=n;g++){let b=g/n*r;f.x=(t+e*Math.cos(m))*Math.cos(b),f.y=(t+e*Math.cos(m))*Math.sin(b),f.z=e*Math.sin(m),c.push(f.x,f.y,f.z),d.x=t*Math.cos(b),d.y=t*Math.sin(b),p.subVectors(f,d).normalize(),h.push(p.x,p.y,p.z),u.push(g/n),u.push(_/i)}}for(let _=1;_<=i;_++)for(let m=1;m<=n;m++){let g=(n+1)*_+m-1,b=(n+1)*(_-1)+m-1,E=(n+1)*(_-1)+m,M=(n+1)*_+m;l.push(g,b,M),l.push(b,E,M)}this.setIndex(l),this.setAttribute("position",new qt(c,3)),this.setAttribute("normal",new qt(h,3)),this.setAttribute("uv",new qt(u,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new s(t.radius,t.tube,t.radialSegments,t.tubularSegments,t.arc,t.thetaStart,t.thetaLength)}};var $r=class extends gi{constructor(t){super(),this.isShadowMaterial=!0,this.type="ShadowMaterial",this.color=new Ct(0),this.transparent=!0,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.fog=t.fog,this}};function es(s){let t={};for(let e in s){t[e]={};for(let i in s[e]){let n=s[e][i];if(Bf(n))n.isRenderTargetTexture?(kt("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),t[e][i]=null):t[e][i]=n.clone();else if(Array.isArray(n))if(Bf(n[0])){let r=[];for(let o=0,a=n.length;o<a;o++)r[o]=n[o].clone();t[e][i]=r}else t[e][i]=n.slice();else t[e][i]=n}}return t}function Xe(s){let t={};for(let e=0;e<s.length;e++){let i=es(s[e]);for(let n in i)t[n]=i[n]}return t}function Bf(s){return s&&(s.isColor||s.isMatrix3||s.isMatrix4||s.isVector2||s.isVector3||s.isVector4||s.isTexture||s.isQuaternion)}function Px(s){let t=[];for(let e=0;e<s.length;e++)t.push(s[e].clone());return t}function yu(s){let t=s.getRenderTarget();return t===null?s.outputColorSpace:t.isXRRenderTarget===!0?t.texture.colorSpace:ne.workingColorSpace}var kp={clone:es,merge:Xe},Lx=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,Nx=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,Me=class extends gi{constructor(t){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=Lx,this.fragmentShader=Nx,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,t!==void 0&&this.setValues(t)}copy(t){return super.copy(t),this.fragmentShader=t.fragmentShader,this.vertexShader=t.vertexShader,this.uniforms=es(t.uniforms),this.uniformsGroups=Px(t.uniformsGroups),this.defines=Object.assign({},t.defines),this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.fog=t.fog,this.lights=t.lights,this.clipping=t.clipping,this.extensions=Object.assign({},t.extensions),this.glslVersion=t.glslVersion,this.defaultAttributeValues=Object.assign({},t.defaultAttributeValues),this.index0AttributeName=t.index0AttributeName,this.uniformsNeedUpdate=t.uniformsNeedUpdate,this}toJSON(t){let e=super.toJSON(t);e.glslVersion=this.glslVersion,e.uniforms={};for(let n in this.uniforms){let o=this.uniforms[n].value;o&&o.isTexture?e.uniforms[n]={type:"t",value:o.toJSON(t).uuid}:o&&o.isColor?e.uniforms[n]={type:"c",value:o.getHex()}:o&&o.isVector2?e.uniforms[n]={type:"v2",value:o.toArray()}:o&&o.isVector3?e.uniforms[n]={type:"v3",value:o.toArray()}:o&&o.isVector4?e.uniforms[n]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?e.uniforms[n]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?e.uniforms[n]={type:"m4",value:o.toArray()}:e.uniforms[n]={value:o}}Object.keys(this.defines).length>0&&(e.defines=this.defines),e.vertexShader=this.vertexShader,e.fragmentShader=this.fragmentShader,e.lights=this.lights,e.clipping=this.clipping;let i={};for(let n in this.extensions)this.extensions[n]===!0&&(i[n]=!0);return Object.keys(i).length>0&&(e.extensions=i),e}fromJSON(t,e){if(super.fromJSON(t,e),t.uniforms!==void 0)for(let i in t.uniforms){let n=t.uniforms[i];switch(this.uniforms[i]={},n.type){case"t":this.uniforms[i].value=e[n.value]||null;break;case"c":this.uniforms[i].value=new Ct().setHex(n.value);break;case"v2":this.uniforms[i].value=new lt().fromArray(n.value);break;case"v3":this.uniforms[i].value=new L().fromArray(n.value);break;case"v4":this.uniforms[i].value=new fe().fromArray(n.value);break;case"m3":this.uniforms[i].value=new Gt().fromArray(n.value);break;case"m4":this.uniforms[i].value=new re().fromArray(n.value);break;default:this.uniforms[i].value=n.value}}if(t.defines!==void 0&&(this.defines=t.defines),t.vertexShader!==void 0&&(this.vertexShader=t.vertexShader),t.fragmentShader!==void 0&&(this.fragmentShader=t.fragmentShader),t.glslVersion!==void 0&&(this.glslVersion=t.glslVersion),t.extensions!==void 0)for(let i in t.extensions)this.extensions[i]=t.extensions[i];return t.lights!==void 0&&(this.lights=t.lights),t.clipping!==void 0&&(this.clipping=t.clipping),this}},tl=class extends Me{constructor(t){super(t),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}},wn=class extends gi{constructor(t){super(),this.isMeshStandardMaterial=!0,this.type="MeshStandardMaterial",this.defines={STANDARD:""},this.color=new Ct(16777215),this.roughness=1,this.metalness=0,this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new Ct(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=uo,this.normalScale=new lt(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.roughnessMap=null,this.metalnessMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new mi,this.envMapIntensity=1,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.defines={STANDARD:""},this.color.copy(t.color),this.roughness=t.roughness,this.metalness=t.metalness,this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.emissive.copy(t.emissive),this.emissiveMap=t.emissiveMap,this.emissiveIntensity=t.emissiveIntensity,this.bumpMap=t.bumpMap,this.bumpScale=t.bumpScale,this.normalMap=t.normalMap,this.normalMapType=t.normalMapType,this.normalScale.copy(t.normalScale),this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.roughnessMap=t.roughnessMap,this.metalnessMap=t.metalnessMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.envMapIntensity=t.envMapIntensity,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.flatShading=t.flatShading,this.fog=t.fog,this}};var Yr=class extends gi{constructor(t){super(),this.isMeshLambertMaterial=!0,this.type="MeshLambertMaterial",this.color=new Ct(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new Ct(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=uo,this.normalScale=new lt(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new mi,this.combine=ml,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.emissive.copy(t.emissive),this.emissiveMap=t.emissiveMap,this.emissiveIntensity=t.emissiveIntensity,this.bumpMap=t.bumpMap,this.bumpScale=t.bumpScale,this.normalMap=t.normalMap,this.normalMapType=t.normalMapType,this.normalScale.copy(t.normalScale),this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.envMapIntensity=t.envMapIntensity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.flatShading=t.flatShading,this.fog=t.fog,this}},el=class extends gi{constructor(t){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=_p,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(t)}copy(t){return super.copy(t),this.depthPacking=t.depthPacking,this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this}},il=class extends gi{constructor(t){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(t)}copy(t){return super.copy(t),this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this}};function _s(s,t){return!s||s.constructor===t?s:typeof t.BYTES_PER_ELEMENT=="number"?new t(s):Array.prototype.slice.call(s)}function wa(s){return s!==void 0&&s.inTangents!==void 0&&s.outTangents!==void 0}var En=class{constructor(t,e,i,n){this.parameterPositions=t,this._cachedIndex=0,this.resultBuffer=n!==void 0?n:new e.constructor(i),this.sampleValues=e,this.valueSize=i,this.settings=null,this.DefaultSettings_={}}evaluate(t){let e=this.parameterPositions,i=this._cachedIndex,n=e[i],r=e[i-1];i:{t:{let o;e:{n:if(!(t<n)){for(let a=i+2;;){if(n===void 0){if(t<r)break n;return i=e.length,this._cachedIndex=i,this.copySampleValue_(i-1)}if(i===a)break;if(r=n,n=e[++i],t<n)break t}o=e.length;break e}if(!(t>=r)){let a=e[1];t<a&&(i=2,r=a);for(let l=i-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(i===l)break;if(n=r,r=e[--i-1],t>=r)break t}o=i,i=0;break e}break i}for(;i<o;){let a=i+o>>>1;t<e[a]?o=a:i=a+1}if(n=e[i],r=e[i-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(n===void 0)return i=e.length,this._cachedIndex=i,this.copySampleValue_(i-1)}this._cachedIndex=i,this.intervalChanged_(i,r,n)}return this.interpolate_(i,r,t,n)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(t){let e=this.resultBuffer,i=this.sampleValues,n=this.valueSize,r=t*n;for(let o=0;o!==n;++o)e[o]=i[r+o];return e}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},nl=class extends En{constructor(t,e,i,n){super(t,e,i,n),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:Uh,endingEnd:Uh}}intervalChanged_(t,e,i){let n=this.parameterPositions,r=t-2,o=t+1,a=n[r],l=n[o];if(a===void 0)switch(this.getSettings_().endingStart){case Oh:r=t,a=2*e-i;break;case Fh:r=n.length-2,a=e+n[r]-n[r+1];break;default:r=t,a=i}if(l===void 0)switch(this.getSettings_().endingEnd){case Oh:o=t,l=2*i-e;break;case Fh:o=1,l=i+n[1]-n[0];break;default:o=t-1,l=e}let c=(i-e)*.5,h=this.valueSize;this._weightPrev=c/(e-a),this._weightNext=c/(l-i),this._offsetPrev=r*h,this._offsetNext=o*h}interpolate_(t,e,i,n){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,h=this._offsetPrev,u=this._offsetNext,d=this._weightPrev,f=this._weightNext,p=(i-e)/(n-e),_=p*p,m=_*p,g=-d*m+2*d*_-d*p,b=(1+d)*m+(-1.5-2*d)*_+(-.5+d)*p+1,E=(-1-f)*m+(1.5+f)*_+.5*p,M=f*m-f*_;for(let T=0;T!==a;++T)r[T]=g*o[h+T]+b*o[c+T]+E*o[l+T]+M*o[u+T];return r}},sl=class extends En{constructor(t,e,i,n){super(t,e,i,n)}interpolate_(t,e,i,n){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,h=(i-e)/(n-e),u=1-h;for(let d=0;d!==a;++d)r[d]=o[c+d]*u+o[l+d]*h;return r}},rl=class extends En{constructor(t,e,i,n){super(t,e,i,n)}interpolate_(t){return this.copySampleValue_(t-1)}},ol=class extends En{interpolate_(t,e,i,n){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,h=this.inTangents,u=this.outTangents;if(!h||!u){let p=(i-e)/(n-e),_=1-p;for(let m=0;m!==a;++m)r[m]=o[c+m]*_+o[l+m]*p;return r}let d=a*2,f=t-1;for(let p=0;p!==a;++p){let _=o[c+p],m=o[l+p],g=f*d+p*2,b=u[g],E=u[g+1],M=t*d+p*2,T=h[M],A=h[M+1],x=Ux(i,e,b,T,n);r[p]=Bp(x,_,E,A,m)}return r}};function Bp(s,t,e,i,n){let r=1-s;return r*r*r*t+3*r*r*s*e+3*r*s*s*i+s*s*s*n}function Dx(s,t,e,i,n){let r=1-s;return 3*r*r*(e-t)+6*r*s*(i-e)+3*s*s*(n-i)}function Ux(s,t,e,i,n){let r=(s-t)/(n-t);for(let o=0;o<8;o++){let a=Bp(r,t,e,i,n)-s;if(Math.abs(a)<1e-10)break;let l=Dx(r,t,e,i,n);if(Math.abs(l)<1e-10)break;r=Math.max(0,Math.min(1,r-a/l))}return r}var hi=class{constructor(t,e,i,n){if(t===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(e===void 0||e.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+t);this.name=t,this.times=_s(e,this.TimeBufferType),this.values=_s(i,this.ValueBufferType),this.setInterpolation(n||this.DefaultInterpolation)}static toJSON(t){let e=t.constructor,i;if(e.toJSON!==this.toJSON)i=e.toJSON(t);else{i={name:t.name,times:_s(t.times,Array),values:_s(t.values,Array)};let n=t.getInterpolation();n!==t.DefaultInterpolation&&(i.interpolation=n),wa(t.settings)&&(i.settings={inTangents:_s(t.settings.inTangents,Array),outTangents:_s(t.settings.outTangents,Array)})}return i.type=t.ValueTypeName,i}InterpolantFactoryMethodDiscrete(t){return new rl(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodLinear(t){return new sl(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodSmooth(t){return new nl(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodBezier(t){let e=new ol(this.times,this.values,this.getValueSize(),t);return this.settings&&(e.inTangents=this.settings.inTangents,e.outTangents=this.settings.outTangents),e}setInterpolation(t){let e;switch(t){case yr:e=this.InterpolantFactoryMethodDiscrete;break;case ka:e=this.InterpolantFactoryMethodLinear;break;case Ta:e=this.InterpolantFactoryMethodSmooth;break;case Dh:e=this.InterpolantFactoryMethodBezier;break}if(e===void 0){let i="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(t!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(i);return kt("KeyframeTrack:",i),this}return this.createInterpolant=e,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return yr;case this.InterpolantFactoryMethodLinear:return ka;case this.InterpolantFactoryMethodSmooth:return Ta;case this.InterpolantFactoryMethodBezier:return Dh}}getValueSize(){return this.values.length/this.times.length}shift(t){if(t!==0){let e=this.times;for(let i=0,n=e.length;i!==n;++i)e[i]+=t;wa(this.settings)&&(zf(this.settings.inTangents,t),zf(this.settings.outTangents,t))}return this}scale(t){if(t!==1){let e=this.times;for(let i=0,n=e.length;i!==n;++i)e[i]*=t;wa(this.settings)&&(Gf(this.settings.inTangents,t),Gf(this.settings.outTangents,t))}return this}trim(t,e){let i=this.times,n=i.length,r=0,o=n-1;for(;r!==n&&i[r]<t;)++r;for(;o!==-1&&i[o]>e;)--o;if(++o,r!==0||o!==n){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=i.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let t=!0,e=this.getValueSize();e-Math.floor(e)!==0&&(Bt("KeyframeTrack: Invalid value size in track.",this),t=!1);let i=this.times,n=this.values,r=i.length;r===0&&(Bt("KeyframeTrack: Track is empty.",this),t=!1);let o=null;for(let a=0;a!==r;a++){let l=i[a];if(typeof l=="number"&&isNaN(l)){Bt("KeyframeTrack: Time is not a valid number.",this,a,l),t=!1;break}if(o!==null&&o>l){Bt("KeyframeTrack: Out of order keys.",this,a,l,o),t=!1;break}o=l}if(n!==void 0&&k0(n))for(let a=0,l=n.length;a!==l;++a){let c=n[a];if(isNaN(c)){Bt("KeyframeTrack: Value is not a valid number.",this,a,c),t=!1;break}}return t}optimize(){let t=this.times.slice(),e=this.values.slice(),i=this.getValueSize(),n=this.getInterpolation()===Ta,r=t.length-1,o=1;for(let a=1;a<r;++a){let l=!1,c=t[a],h=t[a+1];if(c!==h&&(a!==1||c!==t[0]))if(n)l=!0;else{let u=a*i,d=u-i,f=u+i;for(let p=0;p!==i;++p){let _=e[u+p];if(_!==e[d+p]||_!==e[f+p]){l=!0;break}}}if(l){if(a!==o){t[o]=t[a];let u=a*i,d=o*i;for(let f=0;f!==i;++f)e[d+f]=e[u+f]}++o}}if(r>0){t[o]=t[r];for(let a=r*i,l=o*i,c=0;c!==i;++c)e[l+c]=e[a+c];++o}return o!==t.length?(this.times=t.slice(0,o),this.values=e.slice(0,o*i)):(this.times=t,this.values=e),this}clone(){let t=this.times.slice(),e=this.values.slice(),i=this.constructor,n=new i(this.name,t,e);return n.createInterpolant=this.createInterpolant,wa(this.settings)&&(n.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),n}};function zf(s,t){for(let e=0,i=s.length;e!==i;e+=2)s[e]+=t}function Gf(s,t){for(let e=0,i=s.length;e!==i;e+=2)s[e]*=t}hi.prototype.ValueTypeName="";hi.prototype.TimeBufferType=Float32Array;hi.prototype.ValueBufferType=Float32Array;hi.prototype.DefaultInterpolation=ka;var An=class extends hi{constructor(t,e,i){super(t,e,i)}};An.prototype.ValueTypeName="bool";An.prototype.ValueBufferType=Array;An.prototype.DefaultInterpolation=yr;An.prototype.InterpolantFactoryMethodLinear=void 0;An.prototype.InterpolantFactoryMethodSmooth=void 0;var al=class extends hi{constructor(t,e,i,n){super(t,e,i,n)}};al.prototype.ValueTypeName="color";var ll=class extends hi{constructor(t,e,i,n){super(t,e,i,n)}};ll.prototype.ValueTypeName="number";var cl=class extends En{constructor(t,e,i,n){super(t,e,i,n)}interpolate_(t,e,i,n){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=(i-e)/(n-e),c=t*a;for(let h=c+a;c!==h;c+=4)Fi.slerpFlat(r,0,o,c-a,o,c,l);return r}},Zr=class extends hi{constructor(t,e,i,n){super(t,e,i,n)}InterpolantFactoryMethodLinear(t){return new cl(this.times,this.values,this.getValueSize(),t)}};Zr.prototype.ValueTypeName="quaternion";Zr.prototype.InterpolantFactoryMethodSmooth=void 0;var Tn=class extends hi{constructor(t,e,i){super(t,e,i)}};Tn.prototype.ValueTypeName="string";Tn.prototype.ValueBufferType=Array;Tn.prototype.DefaultInterpolation=yr;Tn.prototype.InterpolantFactoryMethodLinear=void 0;Tn.prototype.InterpolantFactoryMethodSmooth=void 0;var hl=class extends hi{constructor(t,e,i,n){super(t,e,i,n)}};hl.prototype.ValueTypeName="vector";var ul=class{constructor(t,e,i){let n=this,r=!1,o=0,a=0,l,c=[];this.onStart=void 0,this.onLoad=t,this.onProgress=e,this.onError=i,this._abortController=null,this.itemStart=function(h){a++,r===!1&&n.onStart!==void 0&&n.onStart(h,o,a),r=!0},this.itemEnd=function(h){o++,n.onProgress!==void 0&&n.onProgress(h,o,a),o===a&&(r=!1,n.onLoad!==void 0&&n.onLoad())},this.itemError=function(h){n.onError!==void 0&&n.onError(h)},this.resolveURL=function(h){return h=h.normalize("NFC"),l?l(h):h},this.setURLModifier=function(h){return l=h,this},this.addHandler=function(h,u){return c.push(h,u),this},this.removeHandler=function(h){let u=c.indexOf(h);return u!==-1&&c.splice(u,2),this},this.getHandler=function(h){for(let u=0,d=c.length;u<d;u+=2){let f=c[u],p=c[u+1];if(f.global&&(f.lastIndex=0),f.test(h))return p}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},zp=new ul,dl=class{constructor(t){this.manager=t!==void 0?t:zp,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(t,e){let i=this;return new Promise(function(n,r){i.load(t,n,e,r)})}parse(){}setCrossOrigin(t){return this.crossOrigin=t,this}setWithCredentials(t){return this.withCredentials=t,this}setPath(t){return this.path=t,this}setResourcePath(t){return this.resourcePath=t,this}setRequestHeader(t){return this.requestHeader=t,this}setPriority(t){return this.priority=t,this}setCache(t){return this.cache=t,this}abort(){return this}};dl.DEFAULT_MATERIAL_NAME="__DEFAULT";var Ds=class extends Ce{static registerNode(t){this.prototype._lightNode=t}constructor(t,e=1){super(),this.isLight=!0,this.type="Light",this.color=new Ct(t),this.intensity=e}copy(t,e){return super.copy(t,e),this.color.copy(t.color),this.intensity=t.intensity,this}toJSON(t){let e=super.toJSON(t);return e.object.color=this.color.getHex(),e.object.intensity=this.intensity,e}},Jr=class extends Ds{constructor(t,e,i){super(t,i),this.isHemisphereLight=!0,this.type="HemisphereLight",this.position.copy(Ce.DEFAULT_UP),this.updateMatrix(),this.groundColor=new Ct(e)}copy(t,e){return super.copy(t,e),this.groundColor.copy(t.groundColor),this}toJSON(t){let e=super.toJSON(t);return e.object.groundColor=this.groundColor.getHex(),e}},Nh=new re,Vf=new L,Hf=new L,jr=class{constructor(t){this.camera=t,this.intensity=1,this.bias=0,this.biasNode=null,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new lt(512,512),this.mapType=ii,this.map=null,this.mapPass=null,this.matrix=new re,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new bn,this._frameExtents=new lt(1,1),this._viewportCount=1,this._viewports=[new fe(0,0,1,1)]}getViewportCount(){return this._viewportCount}getCamera(){return this.camera}getFrustum(){return this._frustum}updateMatrices(t){let e=this.camera;Vf.setFromMatrixPosition(t.matrixWorld),e.position.copy(Vf),Hf.setFromMatrixPosition(t.target.matrixWorld),e.lookAt(Hf),e.updateMatrixWorld(),this._updateMatrix(e,this.matrix,this._frustum)}_updateMatrix(t,e,i,n){Nh.multiplyMatrices(t.projectionMatrix,t.matrixWorldInverse),i.setFromProjectionMatrix(Nh,t.coordinateSystem,t.reversedDepth);let r=this._frameExtents,o=n?n.z/r.x:1,a=n?n.w/r.y:1,l=n?n.x/r.x:0,c=n?n.y/r.y:0;t.coordinateSystem===Ss||t.reversedDepth?e.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,1,0,0,0,0,1):e.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,.5,.5,0,0,0,1),e.multiply(Nh)}getViewport(t){return this._viewports[t]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(t){return this.camera=t.camera.clone(),this.intensity=t.intensity,this.bias=t.bias,this.radius=t.radius,this.autoUpdate=t.autoUpdate,this.needsUpdate=t.needsUpdate,this.normalBias=t.normalBias,this.blurSamples=t.blurSamples,this.mapSize.copy(t.mapSize),this.mapType=t.mapType,this.biasNode=t.biasNode,this}clone(){return new this.constructor().copy(this)}toJSON(){let t={};return t.intensity=this.intensity,t.bias=this.bias,t.normalBias=this.normalBias,t.radius=this.radius,t.blurSamples=this.blurSamples,t.mapSize=this.mapSize.toArray(),t.mapType=this.mapType,t.camera=this.camera.toJSON(!1).object,delete t.camera.matrix,t}},Ea=new L,Aa=new Fi,Di=new L,Kr=class extends Ce{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new re,this.projectionMatrix=new re,this.projectionMatrixInverse=new re,this.coordinateSystem=pi,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(t,e){return super.copy(t,e),this.matrixWorldInverse.copy(t.matrixWorldInverse),this.projectionMatrix.copy(t.projectionMatrix),this.projectionMatrixInverse.copy(t.projectionMatrixInverse),this.coordinateSystem=t.coordinateSystem,this}getWorldDirection(t){return super.getWorldDirection(t).negate()}updateMatrixWorld(t){super.updateMatrixWorld(t),this.matrixWorld.decompose(Ea,Aa,Di),Di.x===1&&Di.y===1&&Di.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Ea,Aa,Di.set(1,1,1)).invert()}updateWorldMatrix(t,e,i=!1){super.updateWorldMatrix(t,e,i),this.matrixWorld.decompose(Ea,Aa,Di),Di.x===1&&Di.y===1&&Di.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Ea,Aa,Di.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},vn=new L,Wf=new lt,Xf=new lt,Oe=class extends Kr{constructor(t=50,e=1,i=.1,n=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=t,this.zoom=1,this.near=i,this.far=n,this.focus=10,this.aspect=e,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.fov=t.fov,this.zoom=t.zoom,this.near=t.near,this.far=t.far,this.focus=t.focus,this.aspect=t.aspect,this.view=t.view===null?null:Object.assign({},t.view),this.filmGauge=t.filmGauge,this.filmOffset=t.filmOffset,this}setFocalLength(t){let e=.5*this.getFilmHeight()/t;this.fov=Ba*2*Math.atan(e),this.updateProjectionMatrix()}getFocalLength(){let t=Math.tan(lh*.5*this.fov);return .5*this.getFilmHeight()/t}getEffectiveFOV(){return Ba*2*Math.atan(Math.tan(lh*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(t,e,i){vn.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),e.set(vn.x,vn.y).multiplyScalar(-t/vn.z),vn.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),i.set(vn.x,vn.y).multiplyScalar(-t/vn.z)}getViewSize(t,e){return this.getViewBounds(t,Wf,Xf),e.subVectors(Xf,Wf)}setViewOffset(t,e,i,n,r,o){this.aspect=t/e,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=i,this.view.offsetY=n,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=this.near,e=t*Math.tan(lh*.5*this.fov)/this.zoom,i=2*e,n=this.aspect*i,r=-.5*n,o=this.view;if(this.view!==null&&this.view.enabled){let l=o.fullWidth,c=o.fullHeight;r+=o.offsetX*n/l,e-=o.offsetY*i/c,n*=o.width/l,i*=o.height/c}let a=this.filmOffset;a!==0&&(r+=t*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+n,e,e-i,t,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.fov=this.fov,e.object.zoom=this.zoom,e.object.near=this.near,e.object.far=this.far,e.object.focus=this.focus,e.object.aspect=this.aspect,this.view!==null&&(e.object.view=Object.assign({},this.view)),e.object.filmGauge=this.filmGauge,e.object.filmOffset=this.filmOffset,e}};var Hh=class extends jr{constructor(){super(new Oe(90,1,.5,500)),this.isPointLightShadow=!0}},Qr=class extends Ds{constructor(t,e,i=0,n=2){super(t,e),this.isPointLight=!0,this.type="PointLight",this.distance=i,this.decay=n,this.shadow=new Hh}get power(){return this.intensity*4*Math.PI}set power(t){this.intensity=t/(4*Math.PI)}dispose(){super.dispose(),this.shadow.dispose()}copy(t,e){return super.copy(t,e),this.distance=t.distance,this.decay=t.decay,this.shadow=t.shadow.clone(),this}toJSON(t){let e=super.toJSON(t);return e.object.distance=this.distance,e.object.decay=this.decay,e.object.shadow=this.shadow.toJSON(),e}},to=class extends Kr{constructor(t=-1,e=1,i=1,n=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=t,this.right=e,this.top=i,this.bottom=n,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.left=t.left,this.right=t.right,this.top=t.top,this.bottom=t.bottom,this.near=t.near,this.far=t.far,this.zoom=t.zoom,this.view=t.view===null?null:Object.assign({},t.view),this}setViewOffset(t,e,i,n,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=i,this.view.offsetY=n,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=(this.right-this.left)/(2*this.zoom),e=(this.top-this.bottom)/(2*this.zoom),i=(this.right+this.left)/2,n=(this.top+this.bottom)/2,r=i-t,o=i+t,a=n+e,l=n-e;if(this.view!==null&&this.view.enabled){let c=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,o=r+c*this.view.width,a-=h*this.view.offsetY,l=a-h*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,l,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.zoom=this.zoom,e.object.left=this.left,e.object.right=this.right,e.object.top=this.top,e.object.bottom=this.bottom,e.object.near=this.near,e.object.far=this.far,this.view!==null&&(e.object.view=Object.assign({},this.view)),e}},Wh=class extends jr{constructor(){super(new to(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}},Us=class extends Ds{constructor(t,e){super(t,e),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(Ce.DEFAULT_UP),this.updateMatrix(),this.target=new Ce,this.shadow=new Wh}dispose(){super.dispose(),this.shadow.dispose()}copy(t){return super.copy(t),this.target=t.target.clone(),this.shadow=t.shadow.clone(),this}toJSON(t){let e=super.toJSON(t);return e.object.shadow=this.shadow.toJSON(),e.object.target=this.target.uuid,e}};var eo=class extends _e{constructor(){super(),this.isInstancedBufferGeometry=!0,this.type="InstancedBufferGeometry",this.instanceCount=1/0}copy(t){return super.copy(t),this.instanceCount=t.instanceCount,this}toJSON(){let t=super.toJSON();return t.instanceCount=this.instanceCount,t.isInstancedBufferGeometry=!0,t}};var vs=-90,ys=1,Os=class extends Ce{constructor(t,e,i){super(),this.type="CubeCamera",this.renderTarget=i,this.coordinateSystem=null,this.activeMipmapLevel=0;let n=new Oe(vs,ys,t,e);n.layers=this.layers,this.add(n);let r=new Oe(vs,ys,t,e);r.layers=this.layers,this.add(r);let o=new Oe(vs,ys,t,e);o.layers=this.layers,this.add(o);let a=new Oe(vs,ys,t,e);a.layers=this.layers,this.add(a);let l=new Oe(vs,ys,t,e);l.layers=this.layers,this.add(l);let c=new Oe(vs,ys,t,e);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){let t=this.coordinateSystem,e=this.children.concat(),[i,n,r,o,a,l]=e;for(let c of e)this.remove(c);if(t===pi)i.up.set(0,1,0),i.lookAt(1,0,0),n.up.set(0,1,0),n.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(t===Ss)i.up.set(0,-1,0),i.lookAt(-1,0,0),n.up.set(0,-1,0),n.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+t);for(let c of e)this.add(c),c.updateMatrixWorld()}update(t,e){this.parent===null&&this.updateMatrixWorld();let{renderTarget:i,activeMipmapLevel:n}=this;this.coordinateSystem!==t.coordinateSystem&&(this.coordinateSystem=t.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,l,c,h]=this.children,u=t.getRenderTarget(),d=t.getActiveCubeFace(),f=t.getActiveMipmapLevel(),p=t.xr.enabled;t.xr.enabled=!1;let _=i.texture.mipmapsAutoUpdate;i.texture.mipmapsAutoUpdate=!1;let m=!1;t.isWebGLRenderer===!0?m=t.state.buffers.depth.getReversed():m=t.reversedDepthBuffer,t.setRenderTarget(i,0,n),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,r),t.setRenderTarget(i,1,n),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,o),t.setRenderTarget(i,2,n),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,a),t.setRenderTarget(i,3,n),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,l),t.setRenderTarget(i,4,n),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,c),i.texture.mipmapsAutoUpdate=_,t.setRenderTarget(i,5,n),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,h),t.setRenderTarget(u,d,f),t.xr.enabled=p,i.texture.needsPMREMUpdate=!0}},fl=class extends Oe{constructor(t=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=t,this.perCameraFrustumCulled=!1}};var bu="\\[\\]\\.:\\/",Ox=new RegExp("["+bu+"]","g"),Mu="[^"+bu+"]",Fx="[^"+bu.replace("\\.","")+"]",kx=/((?:WC+[\/:])*)/.source.replace("WC",Mu),Bx=/(WCOD+)?/.source.replace("WCOD",Fx),zx=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",Mu),Gx=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",Mu),Vx=new RegExp("^"+kx+Bx+zx+Gx+"$"),Hx=["material","materials","bones","map"],Xh=class{constructor(t,e,i){let n=i||me.parseTrackName(e);this._targetGroup=t,this._bindings=t.subscribe_(e,n)}getValue(t,e){this.bind();let i=this._targetGroup.nCachedObjects_,n=this._bindings[i];n!==void 0&&n.getValue(t,e)}setValue(t,e){let i=this._bindings;for(let n=this._targetGroup.nCachedObjects_,r=i.length;n!==r;++n)i[n].setValue(t,e)}bind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,i=t.length;e!==i;++e)t[e].bind()}unbind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,i=t.length;e!==i;++e)t[e].unbind()}},me=class s{constructor(t,e,i){this.path=e,this.parsedPath=i||s.parseTrackName(e),this.node=s.findNode(t,this.parsedPath.nodeName),this.rootNode=t,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(t,e,i){return t&&t.isAnimationObjectGroup?new s.Composite(t,e,i):new s(t,e,i)}static sanitizeNodeName(t){return t.replace(/\s/g,"_").replace(Ox,"")}static parseTrackName(t){let e=Vx.exec(t);if(e===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+t);let i={nodeName:e[2],objectName:e[3],objectIndex:e[4],propertyName:e[5],propertyIndex:e[6]},n=i.nodeName&&i.nodeName.lastIndexOf(".");if(n!==void 0&&n!==-1){let r=i.nodeName.substring(n+1);Hx.indexOf(r)!==-1&&(i.nodeName=i.nodeName.substring(0,n),i.objectName=r)}if(i.propertyName===null||i.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+t);return i}static findNode(t,e){if(e===void 0||e===""||e==="."||e===-1||e===t.name||e===t.uuid)return t;if(t.skeleton){let i=t.skeleton.getBoneByName(e);if(i!==void 0)return i}if(t.children){let i=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===e||a.uuid===e)return a;let l=i(a.children);if(l)return l}return null},n=i(t.children);if(n)return n}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(t,e){t[e]=this.targetObject[this.propertyName]}_getValue_array(t,e){let i=this.resolvedProperty;for(let n=0,r=i.length;n!==r;++n)t[e++]=i[n]}_getValue_arrayElement(t,e){t[e]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(t,e){this.resolvedProperty.toArray(t,e)}_setValue_direct(t,e){this.targetObject[this.propertyName]=t[e]}_setValue_direct_setNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(t,e){let i=this.resolvedProperty;for(let n=0,r=i.length;n!==r;++n)i[n]=t[e++]}_setValue_array_setNeedsUpdate(t,e){let i=this.resolvedProperty;for(let n=0,r=i.length;n!==r;++n)i[n]=t[e++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(t,e){let i=this.resolvedProperty;for(let n=0,r=i.length;n!==r;++n)i[n]=t[e++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(t,e){this.resolvedProperty[this.propertyIndex]=t[e]}_setValue_arrayElement_setNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(t,e){this.resolvedProperty.fromArray(t,e)}_setValue_fromArray_setNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(t,e){this.bind(),this.getValue(t,e)}_setValue_unbound(t,e){this.bind(),this.setValue(t,e)}bind(){let t=this.node,e=this.parsedPath,i=e.objectName,n=e.propertyName,r=e.propertyIndex;if(t||(t=s.findNode(this.rootNode,e.nodeName),this.node=t),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!t){kt("PropertyBinding: No target node found for track: "+this.path+".");return}if(i){let c=e.objectIndex;switch(i){case"materials":if(!t.material){Bt("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.materials){Bt("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}t=t.material.materials;break;case"bones":if(!t.skeleton){Bt("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}t=t.skeleton.bones;for(let h=0;h<t.length;h++)if(t[h].name===c){c=h;break}break;case"map":if("map"in t){t=t.map;break}if(!t.material){Bt("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.map){Bt("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}t=t.material.map;break;default:if(t[i]===void 0){Bt("PropertyBinding: Can not bind to objectName of node undefined.",this);return}t=t[i]}if(c!==void 0){if(t[c]===void 0){Bt("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,t);return}t=t[c]}}let o=t[n];if(o===void 0){let c=e.nodeName;Bt("PropertyBinding: Trying to update property for track: "+c+"."+n+" but it wasn't found.",t);return}let a=this.Versioning.None;this.targetObject=t,t.isMaterial===!0?a=this.Versioning.NeedsUpdate:t.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let l=this.BindingType.Direct;if(r!==void 0){if(n==="morphTargetInfluences"){if(!t.geometry){Bt("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!t.geometry.morphAttributes){Bt("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}t.morphTargetDictionary[r]!==void 0&&(r=t.morphTargetDictionary[r])}l=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(l=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(l=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=n;this.getValue=this.GetterByBindingType[l],this.setValue=this.SetterByBindingTypeAndVersioning[l][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};me.Composite=Xh;me.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};me.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};me.prototype.GetterByBindingType=[me.prototype._getValue_direct,me.prototype._getValue_array,me.prototype._getValue_arrayElement,me.prototype._getValue_toArray];me.prototype.SetterByBindingTypeAndVersioning=[[me.prototype._setValue_direct,me.prototype._setValue_direct_setNeedsUpdate,me.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[me.prototype._setValue_array,me.prototype._setValue_array_setNeedsUpdate,me.prototype._setValue_array_setMatrixWorldNeedsUpdate],[me.prototype._setValue_arrayElement,me.prototype._setValue_arrayElement_setNeedsUpdate,me.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[me.prototype._setValue_fromArray,me.prototype._setValue_fromArray_setNeedsUpdate,me.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var H1=new Float32Array(1);var io=class extends Rr{constructor(t,e,i=1){super(t,e),this.isInstancedInterleavedBuffer=!0,this.meshPerAttribute=i}copy(t){return super.copy(t),this.meshPerAttribute=t.meshPerAttribute,this}clone(t){let e=super.clone(t);return e.meshPerAttribute=this.meshPerAttribute,e}toJSON(t){let e=super.toJSON(t);return e.isInstancedInterleavedBuffer=!0,e.meshPerAttribute=this.meshPerAttribute,e}};var qf=new re,no=class{constructor(t,e,i=0,n=1/0){this.ray=new $n(t,e),this.near=i,this.far=n,this.camera=null,this.layers=new As,this.params={Mesh:{},Line:{threshold:1},LOD:{},Points:{threshold:1},Sprite:{}}}set(t,e){this.ray.set(t,e)}setFromCamera(t,e){e.isPerspectiveCamera?(this.ray.origin.setFromMatrixPosition(e.matrixWorld),this.ray.direction.set(t.x,t.y,.5).unproject(e).sub(this.ray.origin).normalize(),this.camera=e):e.isOrthographicCamera?(this.ray.origin.set(t.x,t.y,e.projectionMatrix.elements[14]).unproject(e),this.ray.direction.set(0,0,-1).transformDirection(e.matrixWorld),this.camera=e):Bt("Raycaster: Unsupported camera type: "+e.type)}setFromXRController(t){return qf.identity().extractRotation(t.matrixWorld),this.ray.origin.setFromMatrixPosition(t.matrixWorld),this.ray.direction.set(0,0,-1).applyMatrix4(qf),this}intersectObject(t,e=!0,i=[]){return qh(t,this,i,e),i.sort($f),i}intersectObjects(t,e=!0,i=[]){for(let n=0,r=t.length;n<r;n++)qh(t[n],this,i,e);return i.sort($f),i}};function $f(s,t){return s.distance-t.distance}function qh(s,t,e,i){let n=!0;if(s.layers.test(t.layers)&&s.raycast(t,e)===!1&&(n=!1),n===!0&&i===!0){let r=s.children;for(let o=0,a=r.length;o<a;o++)qh(r[o],t,e,!0)}}var Ru=class Ru{constructor(t,e,i,n){this.elements=[1,0,0,1],t!==void 0&&this.set(t,e,i,n)}identity(){return this.set(1,0,0,1),this}fromArray(t,e=0){for(let i=0;i<4;i++)this.elements[i]=t[i+e];return this}set(t,e,i,n){let r=this.elements;return r[0]=t,r[2]=e,r[1]=i,r[3]=n,this}};Ru.prototype.isMatrix2=!0;var $h=Ru;function Su(s,t,e,i){let n=Wx(i);switch(e){case du:return s*t;case Ml:return s*t/n.components*n.byteLength;case Sl:return s*t/n.components*n.byteLength;case Cn:return s*t*2/n.components*n.byteLength;case wl:return s*t*2/n.components*n.byteLength;case fu:return s*t*3/n.components*n.byteLength;case Ci:return s*t*4/n.components*n.byteLength;case El:return s*t*4/n.components*n.byteLength;case ro:case oo:return Math.floor((s+3)/4)*Math.floor((t+3)/4)*8;case ao:case lo:return Math.floor((s+3)/4)*Math.floor((t+3)/4)*16;case Tl:case Cl:return Math.max(s,16)*Math.max(t,8)/4;case Al:case Rl:return Math.max(s,8)*Math.max(t,8)/2;case Il:case Pl:case Nl:case Dl:return Math.floor((s+3)/4)*Math.floor((t+3)/4)*8;case Ll:case co:case Ul:return Math.floor((s+3)/4)*Math.floor((t+3)/4)*16;case Ol:return Math.floor((s+3)/4)*Math.floor((t+3)/4)*16;case Fl:return Math.floor((s+4)/5)*Math.floor((t+3)/4)*16;case kl:return Math.floor((s+4)/5)*Math.floor((t+4)/5)*16;case Bl:return Math.floor((s+5)/6)*Math.floor((t+4)/5)*16;case zl:return Math.floor((s+5)/6)*Math.floor((t+5)/6)*16;case Gl:return Math.floor((s+7)/8)*Math.floor((t+4)/5)*16;case Vl:return Math.floor((s+7)/8)*Math.floor((t+5)/6)*16;case Hl:return Math.floor((s+7)/8)*Math.floor((t+7)/8)*16;case Wl:return Math.floor((s+9)/10)*Math.floor((t+4)/5)*16;case Xl:return Math.floor((s+9)/10)*Math.floor((t+5)/6)*16;case ql:return Math.floor((s+9)/10)*Math.floor((t+7)/8)*16;case $l:return Math.floor((s+9)/10)*Math.floor((t+9)/10)*16;case Yl:return Math.floor((s+11)/12)*Math.floor((t+9)/10)*16;case Zl:return Math.floor((s+11)/12)*Math.floor((t+11)/12)*16;case Jl:case jl:case Kl:return Math.ceil(s/4)*Math.ceil(t/4)*16;case Ql:case tc:return Math.ceil(s/4)*Math.ceil(t/4)*8;case ho:case ec:return Math.ceil(s/4)*Math.ceil(t/4)*16}throw new Error(`Unable to determine texture byte length for ${e} format.`)}function Wx(s){switch(s){case ii:case lu:return{byteLength:1,components:1};case zs:case cu:case Ri:return{byteLength:2,components:1};case yl:case bl:return{byteLength:2,components:4};case Ti:case vl:case xi:return{byteLength:4,components:1};case hu:case uu:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${s}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?kt("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");/**
 * @license
 * Copyright 2010-2026 Three.js Authors
 * SPDX-License-Identifier: MIT
 */function lm(){let s=null,t=!1,e=null,i=null;function n(r,o){i=s.requestAnimationFrame(n),e(r,o)}return{start:function(){t!==!0&&e!==null&&s!==null&&(i=s.requestAnimationFrame(n),t=!0)},stop:function(){s!==null&&s.cancelAnimationFrame(i),t=!1},setAnimationLoop:function(r){e=r},setContext:function(r){s=r}}}function Jx(s){let t=new WeakMap;function e(a,l){let c=a.array,h=a.usage,u=c.byteLength,d=s.createBuffer();s.bindBuffer(l,d),s.bufferData(l,c,h),a.onUploadCallback();let f;if(c instanceof Float32Array)f=s.FLOAT;else if(typeof Float16Array<"u"&&c instanceof Float16Array)f=s.HALF_FLOAT;else if(c instanceof Uint16Array)a.isFloat16BufferAttribute?f=s.HALF_FLOAT:f=s.UNSIGNED_SHORT;else if(c instanceof Int16Array)f=s.SHORT;else if(c instanceof Uint32Array)f=s.UNSIGNED_INT;else if(c instanceof Int32Array)f=s.INT;else if(c instanceof Int8Array)f=s.BYTE;else if(c instanceof Uint8Array)f=s.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)f=s.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:d,type:f,bytesPerElement:c.BYTES_PER_ELEMENT,version:a.version,size:u}}function i(a,l,c){let h=l.array,u=l.updateRanges;if(s.bindBuffer(c,a),u.length===0)s.bufferSubData(c,0,h);else{u.sort((f,p)=>f.start-p.start);let d=0;for(let f=1;f<u.length;f++){let p=u[d],_=u[f];_.start<=p.start+p.count+1?p.count=Math.max(p.count,_.start+_.count-p.start):(++d,u[d]=_)}u.length=d+1;for(let f=0,p=u.length;f<p;f++){let _=u[f];s.bufferSubData(c,_.start*h.BYTES_PER_ELEMENT,h,_.start,_.count)}l.clearUpdateRanges()}l.onUploadCallback()}function n(a){return a.isInterleavedBufferAttribute&&(a=a.data),t.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let l=t.get(a);l&&(s.deleteBuffer(l.buffer),t.delete(a))}function o(a,l){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let h=t.get(a);(!h||h.version<a.version)&&t.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let c=t.get(a);if(c===void 0)t.set(a,e(a,l));else if(c.version<a.version){if(c.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");i(c.buffer,a,l),c.version=a.version}}return{get:n,remove:r,update:o}}var jx=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,Kx=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,Qx=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,t_=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,e_=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,i_=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,n_=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,s_=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,r_=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec4 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 );
	}
#endif`,o_=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,a_=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,l_=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,c_=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,h_=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,u_=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,d_=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,f_=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,p_=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,m_=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,g_=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,x_=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,__=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,v_=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec4( 1.0 );
#endif
#ifdef USE_COLOR_ALPHA
	vColor *= color;
#elif defined( USE_COLOR )
	vColor.rgb *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.rgb *= instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
	vColor *= getBatchingColor( getIndirectIndex( gl_DrawID ) );
#endif`,y_=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix( in vec3 normal, in mat4 viewMatrix ) {
	return normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );
}
vec3 transformDirectionByInverseViewMatrix( in vec3 dir, in mat4 viewMatrix ) {
	return normalize( ( vec4( dir, 0.0 ) * viewMatrix ).xyz );
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,b_=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
#endif`,M_=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,S_=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,w_=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,E_=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,A_="gl_FragColor = linearToOutputTexel( gl_FragColor );",T_=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,R_=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * reflectVec );
		#ifdef ENVMAP_BLENDING_MULTIPLY
			outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_MIX )
			outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_ADD )
			outgoingLight += envColor.xyz * specularStrength * reflectivity;
		#endif
	#endif
#endif`,C_=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,I_=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,P_=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,L_=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,N_=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,D_=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,U_=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,O_=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,F_=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,k_=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,B_=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,z_=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,G_=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_SUN_LIGHTS > 0
	struct SunLight {
		vec3 direction;
		vec3 color;
	};
	uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
	void getSunLightInfo( const in SunLight sunLight, out IncidentLight light ) {
		light.color = sunLight.color;
		light.direction = sunLight.direction;
		light.visible = true;
	}
#endif
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif
#include <lightprobes_pars_fragment>`,V_=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * worldNormal, ENVMAP_MAX_LOD );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, pow4( roughness ) ) );
			reflectVec = transformDirectionByInverseViewMatrix( reflectVec, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * reflectVec, roughnessToMip( roughness ) );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_RETROREFLECTION
		vec3 getIBLRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 retroVec = normalize( mix( viewDir, normal, pow4( roughness ) ) );
				retroVec = transformDirectionByInverseViewMatrix( retroVec, viewMatrix );
				vec4 envMapColor = textureLod( envMap, envMapRotation * retroVec, roughnessToMip( roughness ) );
				return envMapColor.rgb * envMapIntensity;
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
		#ifdef USE_RETROREFLECTION
			vec3 getIBLAnisotropyRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
				#ifdef ENVMAP_TYPE_PMREM
					vec3 bentNormal = cross( bitangent, viewDir );
					bentNormal = normalize( cross( bentNormal, bitangent ) );
					bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
					return getIBLRetroRadiance( viewDir, bentNormal, roughness );
				#else
					return vec3( 0.0 );
				#endif
			}
		#endif
	#endif
#endif`,H_=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,W_=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,X_=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,q_=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,$_=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.diffuseContribution = diffuseColor.rgb * ( 1.0 - metalnessFactor );
material.metalness = metalnessFactor;
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.045 );
material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef USE_DIFFUSE_ROUGHNESS
	float diffuseRoughnessFactor = diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		diffuseRoughnessFactor *= texture2D( diffuseRoughnessMap, vDiffuseRoughnessMapUv ).r;
	#endif
	material.diffuseRoughness = saturate( diffuseRoughnessFactor );
#endif
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor;
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = vec3( 0.04 );
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.045 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_RETROREFLECTION
	material.retroreflectivity = retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.0001, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,Y_=`uniform sampler2D dfgLUT;
struct PhysicalMaterial {
	vec3 diffuseColor;
	vec3 diffuseContribution;
	vec3 specularColor;
	vec3 specularColorBlended;
	float roughness;
	float metalness;
	float specularF90;
	float dispersion;
	vec2 dfg;
	vec3 multiScatteringCompensation;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float diffuseRoughness;
	#endif
	#ifdef USE_RETROREFLECTION
		float retroreflectivity;
	#endif
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0Dielectric;
		vec3 iridescenceF0Metallic;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
#ifdef USE_DIFFUSE_ROUGHNESS
	const float EON_EPSILON = 1e-7;
	float FON_DirectionalAlbedo( const in float mu, const in float roughness, const in float A ) {
		float muComp = 1.0 - mu;
		float gOverPi = muComp * ( 0.0571085289 + muComp * ( 0.491881867 + muComp * ( - 0.332181442 + muComp * 0.0714429953 ) ) );
		return A * ( 1.0 + roughness * gOverPi );
	}
	vec3 BRDF_EON( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 diffuseColor, const in float roughness ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return BRDF_Lambert( rho );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float s = dot( lightDir, viewDir ) - dotNL * dotNV;
		float sOverT = ( s > 0.0 ) ? s / max( max( dotNL, dotNV ), EON_EPSILON ) : s;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		vec3 singleScatter = rho * RECIPROCAL_PI * A * ( 1.0 + roughness * sOverT );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		float albedoV = FON_DirectionalAlbedo( dotNV, roughness, A );
		float albedoL = FON_DirectionalAlbedo( dotNL, roughness, A );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		vec3 multiScatter = rhoMultiScatter * RECIPROCAL_PI
			* max( EON_EPSILON, 1.0 - albedoV )
			* max( EON_EPSILON, 1.0 - albedoL )
			/ max( EON_EPSILON, 1.0 - averageAlbedo );
		return singleScatter + multiScatter;
	}
	vec3 EON_DirectionalAlbedo( const in vec3 diffuseColor, const in float roughness, const in float dotNV ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return rho;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		float directionalAlbedo = FON_DirectionalAlbedo( dotNV, roughness, A );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		return rho * directionalAlbedo + rhoMultiScatter * ( 1.0 - directionalAlbedo );
	}
#endif
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		return 0.5 / max( gv + gl, EPSILON );
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = max( material.clearcoatRoughness, 0.045 );
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColorBlended;
	float f90 = material.specularF90;
	float roughness = max( material.roughness, 0.045 );
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float alphaT = max( material.alphaT, alpha );
		float V = V_GGX_SmithCorrelated_Anisotropic( alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transpose( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float rInv = 1.0 / ( roughness + 0.1 );
	float a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * rInv;
	float b = -0.6014 + 0.5538 * roughness - 0.4670 * r2 - 0.1255 * rInv;
	float DG = exp( a * dotNV + b );
	return saturate( DG );
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	vec2 fab = texture2D( dfgLUT, vec2( roughness, dotNV ) ).rg;
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec2 fab, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec2 fab, const in vec3 specularColor, const in float specularF90, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColorBlended * t2.x + ( material.specularF90 - material.specularColorBlended ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseContribution * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
		#ifdef USE_CLEARCOAT
			vec3 Ncc = geometryClearcoatNormal;
			vec2 uvClearcoat = LTC_Uv( Ncc, viewDir, material.clearcoatRoughness );
			vec4 t1Clearcoat = texture2D( ltc_1, uvClearcoat );
			vec4 t2Clearcoat = texture2D( ltc_2, uvClearcoat );
			mat3 mInvClearcoat = mat3(
				vec3( t1Clearcoat.x, 0, t1Clearcoat.y ),
				vec3(             0, 1,             0 ),
				vec3( t1Clearcoat.z, 0, t1Clearcoat.w )
			);
			vec3 fresnelClearcoat = material.clearcoatF0 * t2Clearcoat.x + ( material.clearcoatF90 - material.clearcoatF0 ) * t2Clearcoat.y;
			clearcoatSpecularDirect += lightColor * fresnelClearcoat * LTC_Evaluate( Ncc, viewDir, position, mInvClearcoat, rectCoords );
		#endif
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
 
 		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
 
 		float sheenAlbedoV = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
 		float sheenAlbedoL = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
 
 		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * max( sheenAlbedoV, sheenAlbedoL );
 
 		irradiance *= sheenEnergyComp;
 
 	#endif
	vec3 specularBRDF = BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	#ifdef USE_RETROREFLECTION
		vec3 retroViewDir = reflect( - geometryViewDir, geometryNormal );
		vec3 retroSpecularBRDF = BRDF_GGX( directLight.direction, retroViewDir, geometryNormal, material );
		specularBRDF = mix( specularBRDF, retroSpecularBRDF, saturate( material.retroreflectivity ) );
	#endif
	reflectedLight.directSpecular += irradiance * specularBRDF * material.multiScatteringCompensation;
	vec3 halfDir = normalize( directLight.direction + geometryViewDir );
	float dotVH = saturate( dot( geometryViewDir, halfDir ) );
	vec3 F = F_Schlick( material.specularColor, material.specularF90, dotVH );
	#ifdef USE_RETROREFLECTION
		vec3 retroHalfDir = normalize( directLight.direction + retroViewDir );
		float dotRetroVH = saturate( dot( retroViewDir, retroHalfDir ) );
		vec3 retroF = F_Schlick( material.specularColor, material.specularF90, dotRetroVH );
		F = mix( F, retroF, saturate( material.retroreflectivity ) );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		vec3 diffuseBRDF = BRDF_EON( directLight.direction, geometryViewDir, geometryNormal, material.diffuseColor, material.diffuseRoughness ) * ( 1.0 - material.metalness );
	#else
		vec3 diffuseBRDF = BRDF_Lambert( material.diffuseContribution );
	#endif
	reflectedLight.directDiffuse += irradiance * diffuseBRDF * ( 1.0 - F );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScattering, multiScattering );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScattering, multiScattering );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuseAlbedo = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness );
		vec3 diffuse = irradiance * RECIPROCAL_PI * diffuseAlbedo * ( 1.0 - singleScattering - multiScattering );
	#else
		vec3 diffuse = irradiance * BRDF_Lambert( material.diffuseContribution ) * ( 1.0 - singleScattering - multiScattering );
	#endif
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		sheenSpecularIndirect += irradiance * material.sheenColor * sheenAlbedo * RECIPROCAL_PI;
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		diffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectDiffuse += diffuse;
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness ) * RECIPROCAL_PI;
 	#endif
	vec3 singleScatteringDielectric = vec3( 0.0 );
	vec3 multiScatteringDielectric = vec3( 0.0 );
	vec3 singleScatteringMetallic = vec3( 0.0 );
	vec3 multiScatteringMetallic = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscatteringIridescence( material.dfg, material.diffuseColor, material.specularF90, material.iridescence, material.iridescenceF0Metallic, singleScatteringMetallic, multiScatteringMetallic );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, singleScatteringMetallic, multiScatteringMetallic );
	#endif
	vec3 singleScattering = mix( singleScatteringDielectric, singleScatteringMetallic, material.metalness );
	vec3 multiScattering = mix( multiScatteringDielectric, multiScatteringMetallic, material.metalness );
	vec3 totalScatteringDielectric = singleScatteringDielectric + multiScatteringDielectric;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuse = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness ) * ( 1.0 - totalScatteringDielectric );
	#else
		vec3 diffuse = material.diffuseContribution * ( 1.0 - totalScatteringDielectric );
	#endif
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	vec3 indirectSpecular = radiance * singleScattering;
	indirectSpecular += multiScattering * cosineWeightedIrradiance;
	vec3 indirectDiffuse = diffuse * cosineWeightedIrradiance;
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		indirectSpecular *= sheenEnergyComp;
		indirectDiffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectSpecular += indirectSpecular;
	reflectedLight.indirectDiffuse += indirectDiffuse;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,Z_=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		vec3 iridescenceFresnelDielectric = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		vec3 iridescenceFresnelMetallic = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.diffuseColor );
		material.iridescenceFresnel = mix( iridescenceFresnelDielectric, iridescenceFresnelMetallic, material.metalness );
		material.iridescenceF0Dielectric = Schlick_to_F0( iridescenceFresnelDielectric, 1.0, dotNVi );
		material.iridescenceF0Metallic = Schlick_to_F0( iridescenceFresnelMetallic, 1.0, dotNVi );
	}
#endif
#ifdef STANDARD
	float dotNVms = saturate( dot( geometryNormal, geometryViewDir ) );
	material.dfg = texture2D( dfgLUT, vec2( material.roughness, dotNVms ) ).rg;
	#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
		float EssMs = material.dfg.x + material.dfg.y;
		material.multiScatteringCompensation = 1.0 + material.specularColorBlended * ( 1.0 / EssMs - 1.0 );
	#endif
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
	SunLight sunLight;
	#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHTS; i ++ ) {
		sunLight = sunLights[ i ];
		getSunLightInfo( sunLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
		sunLightShadow = sunLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getSunShadow( sunShadowMap[ i ], sunLightShadow, UNROLLED_LOOP_INDEX ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_LIGHT_PROBE_GRIDS > 0
		vec3 probeWorldPos = ( ( vec4( geometryPosition, 1.0 ) - viewMatrix[ 3 ] ) * viewMatrix ).xyz;
		vec3 probeWorldNormal = transformNormalByInverseViewMatrix( geometryNormal, viewMatrix );
		int probeGrid = - 1;
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( isInsideLightProbeGrid( probeWorldPos, probeWorldNormal, probesMin[ i ], probesMax[ i ], probesResolution[ i ] ) ) probeGrid = UNROLLED_LOOP_INDEX;
		}
		#pragma unroll_loop_end
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( probeGrid == UNROLLED_LOOP_INDEX ) irradiance += getLightProbeGridIrradiance( probesSH[ i ], probesMin[ i ], probesMax[ i ], probesResolution[ i ], probeWorldPos, probeWorldNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,J_=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
		#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
			iblIrradiance += getIBLIrradiance( geometryNormal );
		#endif
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		vec3 iblRadiance = getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		vec3 iblRadiance = getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_RETROREFLECTION
		#ifdef USE_ANISOTROPY
			vec3 retroIBLRadiance = getIBLAnisotropyRetroRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
		#else
			vec3 retroIBLRadiance = getIBLRetroRadiance( geometryViewDir, geometryNormal, material.roughness );
		#endif
		iblRadiance = mix( iblRadiance, retroIBLRadiance, saturate( material.retroreflectivity ) );
	#endif
	radiance += iblRadiance;
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,j_=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,K_=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {
	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );
}
vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {
	vec3 res = probesResolution;
	vec3 gridRange = probesMax - probesMin;
	vec3 probeSpacing = gridRange / res;
	vec3 samplePos = worldPos + worldNormal * probeSpacing * 0.5;
	vec3 uvw = clamp( ( samplePos - probesMin ) / gridRange, 0.5 / res, 1.0 - 0.5 / res );
	float nz          = res.z;
	float paddedSlices = nz + 2.0;
	float atlasDepth  = 7.0 * paddedSlices;
	float uvZBase     = uvw.z * nz + 1.0;
	vec4 s0 = texture( probesSH, vec3( uvw.xy, ( uvZBase                       ) / atlasDepth ) );
	vec4 s1 = texture( probesSH, vec3( uvw.xy, ( uvZBase +       paddedSlices   ) / atlasDepth ) );
	vec4 s2 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 2.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s3 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 3.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s4 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 4.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s5 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 5.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s6 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 6.0 * paddedSlices   ) / atlasDepth ) );
	vec3 c0 = s0.xyz;
	vec3 c1 = vec3( s0.w, s1.xy );
	vec3 c2 = vec3( s1.zw, s2.x );
	vec3 c3 = s2.yzw;
	vec3 c4 = s3.xyz;
	vec3 c5 = vec3( s3.w, s4.xy );
	vec3 c6 = vec3( s4.zw, s5.x );
	vec3 c7 = s5.yzw;
	vec3 c8 = s6.xyz;
	float x = worldNormal.x, y = worldNormal.y, z = worldNormal.z;
	vec3 result = c0 * 0.886227;
	result += c1 * 2.0 * 0.511664 * y;
	result += c2 * 2.0 * 0.511664 * z;
	result += c3 * 2.0 * 0.511664 * x;
	result += c4 * 2.0 * 0.429043 * x * y;
	result += c5 * 2.0 * 0.429043 * y * z;
	result += c6 * ( 0.743125 * z * z - 0.247708 );
	result += c7 * 2.0 * 0.429043 * x * z;
	result += c8 * 0.429043 * ( x * x - y * y );
	return max( result, vec3( 0.0 ) );
}
#endif`,Q_=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,tv=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,ev=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,iv=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,nv=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,sv=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,rv=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,ov=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,av=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,lv=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,cv=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,hv=`#if defined( USE_MORPHCOLORS )
	#if defined( USE_COLOR_ALPHA )
		vColor *= morphTargetBaseInfluence;
	#elif defined( USE_COLOR )
		vColor.rgb *= morphTargetBaseInfluence;
	#endif
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor.rgb += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,uv=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,dv=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,fv=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,pv=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#ifdef DOUBLE_SIDED
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#ifdef DOUBLE_SIDED
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,mv=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#if defined( USE_PACKED_NORMALMAP )
		mapN = vec3( mapN.xy, sqrt( saturate( 1.0 - dot( mapN.xy, mapN.xy ) ) ) );
	#endif
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,gv=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,xv=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,_v=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,vv=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,yv=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,bv=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,Mv=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,Sv=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,wv=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,Ev=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	#ifdef USE_REVERSED_DEPTH_BUFFER
	
		return depth * ( far - near ) - far;
	#else
		return depth * ( near - far ) - near;
	#endif
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	
	#ifdef USE_REVERSED_DEPTH_BUFFER
		return ( near * far ) / ( ( near - far ) * depth - near );
	#else
		return ( near * far ) / ( ( far - near ) * depth - far );
	#endif
}`,Av=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,Tv=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,Rv=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,Cv=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,Iv=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,Pv=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,Lv=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		#define SUN_LIGHT_CASCADES 2
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#else
			uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#endif
		uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
		struct SunLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#else
			uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#endif
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#else
			uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#endif
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#elif defined( SHADOWMAP_TYPE_BASIC )
			uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#endif
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float interleavedGradientNoise( vec2 position ) {
			return fract( 52.9829189 * fract( dot( position, vec2( 0.06711056, 0.00583715 ) ) ) );
		}
		vec2 vogelDiskSample( int sampleIndex, int samplesCount, float phi ) {
			const float goldenAngle = 2.399963229728653;
			float r = sqrt( ( float( sampleIndex ) + 0.5 ) / float( samplesCount ) );
			float theta = float( sampleIndex ) * goldenAngle + phi;
			return vec2( cos( theta ), sin( theta ) ) * r;
		}
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float getShadow( sampler2DShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
				vec2 radius = shadowRadius * texelSize;
				float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
				shadow = (
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 0, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 1, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 2, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 3, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 4, 5, phi ) * radius, shadowCoord.z ) )
				) * 0.2;
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#elif defined( SHADOWMAP_TYPE_VSM )
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 distribution = texture2D( shadowMap, shadowCoord.xy ).rg;
				float mean = distribution.x;
				float variance = distribution.y * distribution.y;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					float hard_shadow = step( mean, shadowCoord.z );
				#else
					float hard_shadow = step( shadowCoord.z, mean );
				#endif
				
				if ( hard_shadow == 1.0 ) {
					shadow = 1.0;
				} else {
					variance = max( variance, 0.0000001 );
					float d = shadowCoord.z - mean;
					float p_max = variance / ( variance + d * d );
					p_max = clamp( ( p_max - 0.3 ) / 0.65, 0.0, 1.0 );
					shadow = max( hard_shadow, p_max );
				}
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#else
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				float depth = texture2D( shadowMap, shadowCoord.xy ).r;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					shadow = step( depth, shadowCoord.z );
				#else
					shadow = step( shadowCoord.z, depth );
				#endif
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#endif
	#if NUM_SUN_LIGHT_SHADOWS > 0
		float getSunShadow(
			#if defined( SHADOWMAP_TYPE_PCF )
				sampler2DShadow shadowMap,
			#else
				sampler2D shadowMap,
			#endif
			SunLightShadow sunLightShadow,
			int shadowIndex
		) {
			vec4 shadowWorldPosition = vec4( vSunShadowWorldPosition.xyz + vSunShadowWorldNormal * sunLightShadow.shadowNormalBias, 1.0 );
			float viewDepth = vSunShadowWorldPosition.w;
			int cascadeOffset = shadowIndex * SUN_LIGHT_CASCADES;
			float shadow = 1.0;
			for ( int i = SUN_LIGHT_CASCADES - 1; i >= 0; i -- ) {
				vec4 cascade = sunShadowCascade[ cascadeOffset + i ];
				if ( viewDepth >= cascade.x && viewDepth < cascade.y ) {
					float cascadeShadow = getShadow(
						shadowMap,
						sunLightShadow.shadowMapSize,
						sunLightShadow.shadowIntensity,
						sunLightShadow.shadowBias,
						sunLightShadow.shadowRadius,
						sunShadowMatrix[ cascadeOffset + i ] * shadowWorldPosition
					);
					shadow = mix( cascadeShadow, shadow, smoothstep( cascade.z, cascade.y, viewDepth ) );
				}
			}
			return shadow;
		}
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	#if defined( SHADOWMAP_TYPE_PCF )
	float getPointShadow( samplerCubeShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 bd3D = normalize( lightToPosition );
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float lightDistance = length( lightToPosition );
			float depthRange = shadowCameraFar - shadowCameraNear;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				float depthA = - shadowCameraNear / depthRange - shadowBias;
				float depthB = shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#else
				float depthA = shadowCameraFar / depthRange + shadowBias;
				float depthB = - shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#endif
			float texelSize = shadowRadius / shadowMapSize.x;
			vec3 absDir = abs( bd3D );
			vec3 tangent = absDir.x > absDir.z ? vec3( 0.0, 1.0, 0.0 ) : vec3( 1.0, 0.0, 0.0 );
			tangent = normalize( cross( bd3D, tangent ) );
			vec3 bitangent = cross( bd3D, tangent );
			float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
			shadow = 0.0;
			for ( int i = 0; i < 5; i ++ ) {
				vec2 offset = vogelDiskSample( i, 5, phi );
				vec3 direction = bd3D + ( tangent * offset.x + bitangent * offset.y ) * texelSize;
				vec3 absDirection = abs( direction );
				float dp = depthA + depthB / max( max( absDirection.x, absDirection.y ), absDirection.z );
				shadow += texture( shadowMap, vec4( direction, dp ) );
			}
			shadow *= 0.2;
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#elif defined( SHADOWMAP_TYPE_BASIC )
	float getPointShadow( samplerCube shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float dp = ( shadowCameraFar * ( viewSpaceZ - shadowCameraNear ) ) / ( viewSpaceZ * ( shadowCameraFar - shadowCameraNear ) );
			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			float depth = textureCube( shadowMap, bd3D ).r;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				depth = 1.0 - depth;
			#endif
			shadow = step( dp, depth );
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#endif
	#endif
#endif`,Nv=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,Dv=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	#ifdef HAS_NORMAL
		vec3 shadowWorldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
	#else
		vec3 shadowWorldNormal = vec3( 0.0 );
	#endif
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_SUN_LIGHT_SHADOWS > 0
		vSunShadowWorldPosition = vec4( worldPosition.xyz, - mvPosition.z );
		vSunShadowWorldNormal = shadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,Uv=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHT_SHADOWS; i ++ ) {
		sunLight = sunLightShadows[ i ];
		shadow *= receiveShadow ? getSunShadow( sunShadowMap[ i ], sunLight, UNROLLED_LOOP_INDEX ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,Ov=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,Fv=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,kv=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,Bv=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,zv=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,Gv=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,Vv=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,Hv=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,Wv=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseContribution, material.specularColorBlended, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,Xv=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		#else
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,qv=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,$v=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	uniform mat3 diffuseRoughnessMapTransform;
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,Yv=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	vDiffuseRoughnessMapUv = ( diffuseRoughnessMapTransform * vec3( DIFFUSE_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,Zv=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,Jv=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,jv=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,Kv=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,Qv=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main() {
	#ifdef ENVMAP_TYPE_PMREM
		vec4 texColor = textureLod( envMap, backgroundRotation * vWorldDirection, roughnessToMip( backgroundBlurriness ) );
	#else
		vec4 texColor = textureCube( envMap, backgroundRotation * vWorldDirection );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,ty=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,ey=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,iy=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,ny=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	#ifdef USE_REVERSED_DEPTH_BUFFER
		float fragCoordZ = vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
	#else
		float fragCoordZ = 0.5 * vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
	#endif
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,sy=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,ry=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = vec4( dist, 0.0, 0.0, 1.0 );
}`,oy=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,ay=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,ly=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,cy=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,hy=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,uy=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,dy=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,fy=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,py=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,my=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,gy=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,xy=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,_y=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,vy=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,yy=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,by=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
	uniform float diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		uniform sampler2D diffuseRoughnessMap;
	#endif
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
	uniform float retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
 
		outgoingLight = outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
 
 	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,My=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Sy=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,wy=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,Ey=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,Ay=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Ty=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,Ry=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,Cy=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,Yt={alphahash_fragment:jx,alphahash_pars_fragment:Kx,alphamap_fragment:Qx,alphamap_pars_fragment:t_,alphatest_fragment:e_,alphatest_pars_fragment:i_,aomap_fragment:n_,aomap_pars_fragment:s_,batching_pars_vertex:r_,batching_vertex:o_,begin_vertex:a_,beginnormal_vertex:l_,bsdfs:c_,iridescence_fragment:h_,bumpmap_pars_fragment:u_,clipping_planes_fragment:d_,clipping_planes_pars_fragment:f_,clipping_planes_pars_vertex:p_,clipping_planes_vertex:m_,color_fragment:g_,color_pars_fragment:x_,color_pars_vertex:__,color_vertex:v_,common:y_,defaultnormal_vertex:b_,displacementmap_pars_vertex:M_,displacementmap_vertex:S_,emissivemap_fragment:w_,emissivemap_pars_fragment:E_,colorspace_fragment:A_,colorspace_pars_fragment:T_,envmap_fragment:R_,envmap_common_pars_fragment:C_,envmap_pars_fragment:I_,envmap_pars_vertex:P_,envmap_physical_pars_fragment:V_,envmap_vertex:L_,fog_vertex:N_,fog_pars_vertex:D_,fog_fragment:U_,fog_pars_fragment:O_,gradientmap_pars_fragment:F_,lightmap_pars_fragment:k_,lights_lambert_fragment:B_,lights_lambert_pars_fragment:z_,lights_pars_begin:G_,lights_toon_fragment:H_,lights_toon_pars_fragment:W_,lights_phong_fragment:X_,lights_phong_pars_fragment:q_,lights_physical_fragment:$_,lights_physical_pars_fragment:Y_,lights_fragment_begin:Z_,lights_fragment_maps:J_,lights_fragment_end:j_,lightprobes_pars_fragment:K_,logdepthbuf_fragment:Q_,logdepthbuf_pars_fragment:tv,logdepthbuf_pars_vertex:ev,logdepthbuf_vertex:iv,map_fragment:nv,map_pars_fragment:sv,map_particle_fragment:rv,map_particle_pars_fragment:ov,metalnessmap_fragment:av,metalnessmap_pars_fragment:lv,morphinstance_vertex:cv,morphcolor_vertex:hv,morphnormal_vertex:uv,morphtarget_pars_vertex:dv,morphtarget_vertex:fv,normal_fragment_begin:pv,normal_fragment_maps:mv,normal_pars_fragment:gv,normal_pars_vertex:xv,normal_vertex:_v,normalmap_pars_fragment:vv,clearcoat_normal_fragment_begin:yv,clearcoat_normal_fragment_maps:bv,clearcoat_pars_fragment:Mv,iridescence_pars_fragment:Sv,opaque_fragment:wv,packing:Ev,premultiplied_alpha_fragment:Av,project_vertex:Tv,dithering_fragment:Rv,dithering_pars_fragment:Cv,roughnessmap_fragment:Iv,roughnessmap_pars_fragment:Pv,shadowmap_pars_fragment:Lv,shadowmap_pars_vertex:Nv,shadowmap_vertex:Dv,shadowmask_pars_fragment:Uv,skinbase_vertex:Ov,skinning_pars_vertex:Fv,skinning_vertex:kv,skinnormal_vertex:Bv,specularmap_fragment:zv,specularmap_pars_fragment:Gv,tonemapping_fragment:Vv,tonemapping_pars_fragment:Hv,transmission_fragment:Wv,transmission_pars_fragment:Xv,uv_pars_fragment:qv,uv_pars_vertex:$v,uv_vertex:Yv,worldpos_vertex:Zv,background_vert:Jv,background_frag:jv,backgroundCube_vert:Kv,backgroundCube_frag:Qv,cube_vert:ty,cube_frag:ey,depth_vert:iy,depth_frag:ny,distance_vert:sy,distance_frag:ry,equirect_vert:oy,equirect_frag:ay,linedashed_vert:ly,linedashed_frag:cy,meshbasic_vert:hy,meshbasic_frag:uy,meshlambert_vert:dy,meshlambert_frag:fy,meshmatcap_vert:py,meshmatcap_frag:my,meshnormal_vert:gy,meshnormal_frag:xy,meshphong_vert:_y,meshphong_frag:vy,meshphysical_vert:yy,meshphysical_frag:by,meshtoon_vert:My,meshtoon_frag:Sy,points_vert:wy,points_frag:Ey,shadow_vert:Ay,shadow_frag:Ty,sprite_vert:Ry,sprite_frag:Cy},yt={common:{diffuse:{value:new Ct(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new Gt},alphaMap:{value:null},alphaMapTransform:{value:new Gt},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new Gt}},envmap:{envMap:{value:null},envMapRotation:{value:new Gt},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new Gt}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new Gt}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new Gt},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new Gt},normalScale:{value:new lt(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new Gt},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new Gt}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new Gt}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new Gt}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new Ct(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new Ct(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new Gt},alphaTest:{value:0},uvTransform:{value:new Gt}},sprite:{diffuse:{value:new Ct(16777215)},opacity:{value:1},center:{value:new lt(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new Gt},alphaMap:{value:null},alphaMapTransform:{value:new Gt},alphaTest:{value:0}}},Hi={basic:{uniforms:Xe([yt.common,yt.specularmap,yt.envmap,yt.aomap,yt.lightmap,yt.fog]),vertexShader:Yt.meshbasic_vert,fragmentShader:Yt.meshbasic_frag},lambert:{uniforms:Xe([yt.common,yt.specularmap,yt.envmap,yt.aomap,yt.lightmap,yt.emissivemap,yt.bumpmap,yt.normalmap,yt.displacementmap,yt.fog,yt.lights,{emissive:{value:new Ct(0)},envMapIntensity:{value:1}}]),vertexShader:Yt.meshlambert_vert,fragmentShader:Yt.meshlambert_frag},phong:{uniforms:Xe([yt.common,yt.specularmap,yt.envmap,yt.aomap,yt.lightmap,yt.emissivemap,yt.bumpmap,yt.normalmap,yt.displacementmap,yt.fog,yt.lights,{emissive:{value:new Ct(0)},specular:{value:new Ct(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:Yt.meshphong_vert,fragmentShader:Yt.meshphong_frag},standard:{uniforms:Xe([yt.common,yt.envmap,yt.aomap,yt.lightmap,yt.emissivemap,yt.bumpmap,yt.normalmap,yt.displacementmap,yt.roughnessmap,yt.metalnessmap,yt.fog,yt.lights,{emissive:{value:new Ct(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:Yt.meshphysical_vert,fragmentShader:Yt.meshphysical_frag},toon:{uniforms:Xe([yt.common,yt.aomap,yt.lightmap,yt.emissivemap,yt.bumpmap,yt.normalmap,yt.displacementmap,yt.gradientmap,yt.fog,yt.lights,{emissive:{value:new Ct(0)}}]),vertexShader:Yt.meshtoon_vert,fragmentShader:Yt.meshtoon_frag},matcap:{uniforms:Xe([yt.common,yt.bumpmap,yt.normalmap,yt.displacementmap,yt.fog,{matcap:{value:null}}]),vertexShader:Yt.meshmatcap_vert,fragmentShader:Yt.meshmatcap_frag},points:{uniforms:Xe([yt.points,yt.fog]),vertexShader:Yt.points_vert,fragmentShader:Yt.points_frag},dashed:{uniforms:Xe([yt.common,yt.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:Yt.linedashed_vert,fragmentShader:Yt.linedashed_frag},depth:{uniforms:Xe([yt.common,yt.displacementmap]),vertexShader:Yt.depth_vert,fragmentShader:Yt.depth_frag},normal:{uniforms:Xe([yt.common,yt.bumpmap,yt.normalmap,yt.displacementmap,{opacity:{value:1}}]),vertexShader:Yt.meshnormal_vert,fragmentShader:Yt.meshnormal_frag},sprite:{uniforms:Xe([yt.sprite,yt.fog]),vertexShader:Yt.sprite_vert,fragmentShader:Yt.sprite_frag},background:{uniforms:{uvTransform:{value:new Gt},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:Yt.background_vert,fragmentShader:Yt.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new Gt}},vertexShader:Yt.backgroundCube_vert,fragmentShader:Yt.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:Yt.cube_vert,fragmentShader:Yt.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:Yt.equirect_vert,fragmentShader:Yt.equirect_frag},distance:{uniforms:Xe([yt.common,yt.displacementmap,{referencePosition:{value:new L},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:Yt.distance_vert,fragmentShader:Yt.distance_frag},shadow:{uniforms:Xe([yt.lights,yt.fog,{color:{value:new Ct(0)},opacity:{value:1}}]),vertexShader:Yt.shadow_vert,fragmentShader:Yt.shadow_frag}};Hi.physical={uniforms:Xe([Hi.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new Gt},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new Gt},clearcoatNormalScale:{value:new lt(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new Gt},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new Gt},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new Gt},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new Gt},sheen:{value:0},sheenColor:{value:new Ct(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new Gt},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new Gt},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new Gt},transmissionSamplerSize:{value:new lt},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new Gt},attenuationDistance:{value:0},attenuationColor:{value:new Ct(0)},specularColor:{value:new Ct(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new Gt},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new Gt},anisotropyVector:{value:new lt},anisotropyMap:{value:null},anisotropyMapTransform:{value:new Gt}}]),vertexShader:Yt.meshphysical_vert,fragmentShader:Yt.meshphysical_frag};var nc={r:0,b:0,g:0},Iy=new re,cm=new Gt;cm.set(-1,0,0,0,1,0,0,0,1);function Py(s,t,e,i,n,r){let o=new Ct(0),a=n===!0?0:1,l,c,h=null,u=0,d=null;function f(b){let E=b.isScene===!0?b.background:null;if(E&&E.isTexture){let M=b.backgroundBlurriness>0;E=t.get(E,M)}return E}function p(b){let E=!1,M=f(b);M===null?m(o,a):M&&M.isColor&&(m(M,1),E=!0);let T=s.xr.getEnvironmentBlendMode();T==="additive"?e.buffers.color.setClear(0,0,0,1,r):T==="alpha-blend"&&e.buffers.color.setClear(0,0,0,0,r),(s.autoClear||E)&&(e.buffers.depth.setTest(!0),e.buffers.depth.setMask(!0),e.buffers.color.setMask(!0),s.clear(s.autoClearColor,s.autoClearDepth,s.autoClearStencil))}function _(b,E){let M=f(E);M&&M.isCubeTexture?(c===void 0&&(c=new Wt(new zi(1,1,1),new Me({name:"BackgroundCubeMaterial",uniforms:es(Hi.backgroundCube.uniforms),vertexShader:Hi.backgroundCube.vertexShader,fragmentShader:Hi.backgroundCube.fragmentShader,side:ze,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),c.geometry.deleteAttribute("uv"),c.onBeforeRender=function(T,A,x){this.matrixWorld.copyPosition(x.matrixWorld)},Object.defineProperty(c.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),i.update(c)),c.material.uniforms.envMap.value=M,c.material.uniforms.backgroundBlurriness.value=E.backgroundBlurriness,c.material.uniforms.backgroundIntensity.value=E.backgroundIntensity,c.material.uniforms.backgroundRotation.value.setFromMatrix4(Iy.makeRotationFromEuler(E.backgroundRotation)).transpose(),M.isRenderTargetTexture===!1&&c.material.uniforms.backgroundRotation.value.premultiply(cm),c.material.toneMapped=ne.getTransfer(M.colorSpace)!==le,(h!==M||u!==M.version||d!==s.toneMapping)&&(c.material.needsUpdate=!0,h=M,u=M.version,d=s.toneMapping),c.layers.enableAll(),b.unshift(c,c.geometry,c.material,0,0,null)):M&&M.isTexture&&(l===void 0&&(l=new Wt(new Mn(2,2),new Me({name:"BackgroundMaterial",uniforms:es(Hi.background.uniforms),vertexShader:Hi.background.vertexShader,fragmentShader:Hi.background.fragmentShader,side:Rn,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),Object.defineProperty(l.material,"map",{get:function(){return this.uniforms.t2D.value}}),i.update(l)),l.material.uniforms.t2D.value=M,l.material.uniforms.backgroundIntensity.value=E.backgroundIntensity,l.material.toneMapped=ne.getTransfer(M.colorSpace)!==le,M.matrixAutoUpdate===!0&&M.updateMatrix(),l.material.uniforms.uvTransform.value.copy(M.matrix),(h!==M||u!==M.version||d!==s.toneMapping)&&(l.material.needsUpdate=!0,h=M,u=M.version,d=s.toneMapping),l.layers.enableAll(),b.unshift(l,l.geometry,l.material,0,0,null))}function m(b,E){b.getRGB(nc,yu(s)),e.buffers.color.setClear(nc.r,nc.g,nc.b,E,r)}function g(){c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0),l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0)}return{getClearColor:function(){return o},setClearColor:function(b,E=1){o.set(b),a=E,m(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(b){a=b,m(o,a)},render:p,addToRenderList:_,dispose:g}}function Ly(s,t){let e=s.getParameter(s.MAX_VERTEX_ATTRIBS),i={},n=d(null),r=n,o=!1;function a(D,F,H,C,z){let X=!1,G=u(D,C,H,F);r!==G&&(r=G,c(r.object)),X=f(D,C,H,z),X&&p(D,C,H,z),z!==null&&t.update(z,s.ELEMENT_ARRAY_BUFFER),(X||o)&&(o=!1,M(D,F,H,C),z!==null&&s.bindBuffer(s.ELEMENT_ARRAY_BUFFER,t.get(z).buffer))}function l(){return s.createVertexArray()}function c(D){return s.bindVertexArray(D)}function h(D){return s.deleteVertexArray(D)}function u(D,F,H,C){let z=C.wireframe===!0,X=i[F.id];X===void 0&&(X={},i[F.id]=X);let G=D.isInstancedMesh===!0?D.id:0,et=X[G];et===void 0&&(et={},X[G]=et);let W=et[H.id];W===void 0&&(W={},et[H.id]=W);let K=W[z];return K===void 0&&(K=d(l()),W[z]=K),K}function d(D){let F=[],H=[],C=[];for(let z=0;z<e;z++)F[z]=0,H[z]=0,C[z]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:F,enabledAttributes:H,attributeDivisors:C,object:D,attributes:{},index:null}}function f(D,F,H,C){let z=r.attributes,X=F.attributes,G=0,et=H.getAttributes();for(let W in et)if(et[W].location>=0){let tt=z[W],St=X[W];if(St===void 0&&(W==="instanceMatrix"&&D.instanceMatrix&&(St=D.instanceMatrix),W==="instanceColor"&&D.instanceColor&&(St=D.instanceColor)),tt===void 0||tt.attribute!==St||St&&tt.data!==St.data)return!0;G++}return r.attributesNum!==G||r.index!==C}function p(D,F,H,C){let z={},X=F.attributes,G=0,et=H.getAttributes();for(let W in et)if(et[W].location>=0){let tt=X[W];tt===void 0&&(W==="instanceMatrix"&&D.instanceMatrix&&(tt=D.instanceMatrix),W==="instanceColor"&&D.instanceColor&&(tt=D.instanceColor));let St={};St.attribute=tt,tt&&tt.data&&(St.data=tt.data),z[W]=St,G++}r.attributes=z,r.attributesNum=G,r.index=C}function _(){let D=r.newAttributes;for(let F=0,H=D.length;F<H;F++)D[F]=0}function m(D){g(D,0)}function g(D,F){let H=r.newAttributes,C=r.enabledAttributes,z=r.attributeDivisors;H[D]=1,C[D]===0&&(s.enableVertexAttribArray(D),C[D]=1),z[D]!==F&&(s.vertexAttribDivisor(D,F),z[D]=F)}function b(){let D=r.newAttributes,F=r.enabledAttributes;for(let H=0,C=F.length;H<C;H++)F[H]!==D[H]&&(s.disableVertexAttribArray(H),F[H]=0)}function E(D,F,H,C,z,X,G){G===!0?s.vertexAttribIPointer(D,F,H,z,X):s.vertexAttribPointer(D,F,H,C,z,X)}function M(D,F,H,C){_();let z=C.attributes,X=H.getAttributes(),G=F.defaultAttributeValues;for(let et in X){let W=X[et];if(W.location>=0){let K=z[et];if(K===void 0&&(et==="instanceMatrix"&&D.instanceMatrix&&(K=D.instanceMatrix),et==="instanceColor"&&D.instanceColor&&(K=D.instanceColor)),K!==void 0){let tt=K.normalized,St=K.itemSize,Ot=t.get(K);if(Ot===void 0)continue;let $=Ot.buffer,xt=Ot.type,wt=Ot.bytesPerElement,Nt=xt===s.INT||xt===s.UNSIGNED_INT||K.gpuType===vl;if(K.isInterleavedBufferAttribute){let _t=K.data,Dt=_t.isInterleavedBuffer===!0?_t.stride:_t.itemSize,pe=K.offset;if(_t.isInstancedInterleavedBuffer||_t.isInstancedBufferAttribute){for(let Ft=0;Ft<W.locationSize;Ft++)g(W.location+Ft,_t.meshPerAttribute);D.isInstancedMesh!==!0&&C._maxInstanceCount===void 0&&(C._maxInstanceCount=_t.meshPerAttribute*_t.count)}else for(let Ft=0;Ft<W.locationSize;Ft++)m(W.location+Ft);s.bindBuffer(s.ARRAY_BUFFER,$);for(let Ft=0;Ft<W.locationSize;Ft++)E(W.location+Ft,St/W.locationSize,xt,tt,Dt*wt,(pe+St/W.locationSize*Ft)*wt,Nt)}else{if(K.isInstancedBufferAttribute){for(let _t=0;_t<W.locationSize;_t++)g(W.location+_t,K.meshPerAttribute);D.isInstancedMesh!==!0&&C._maxInstanceCount===void 0&&(C._maxInstanceCount=K.meshPerAttribute*K.count)}else for(let _t=0;_t<W.locationSize;_t++)m(W.location+_t);s.bindBuffer(s.ARRAY_BUFFER,$);for(let _t=0;_t<W.locationSize;_t++)E(W.location+_t,St/W.locationSize,xt,tt,St*wt,St/W.locationSize*_t*wt,Nt)}}else if(G!==void 0){let tt=G[et];if(tt!==void 0)switch(tt.length){case 2:s.vertexAttrib2fv(W.location,tt);break;case 3:s.vertexAttrib3fv(W.location,tt);break;case 4:s.vertexAttrib4fv(W.location,tt);break;default:s.vertexAttrib1fv(W.location,tt)}}}}b()}function T(){U();for(let D in i){let F=i[D];for(let H in F){let C=F[H];for(let z in C){let X=C[z];for(let G in X)h(X[G].object),delete X[G];delete C[z]}}delete i[D]}}function A(D){if(i[D.id]===void 0)return;let F=i[D.id];for(let H in F){let C=F[H];for(let z in C){let X=C[z];for(let G in X)h(X[G].object),delete X[G];delete C[z]}}delete i[D.id]}function x(D){for(let F in i){let H=i[F];for(let C in H){let z=H[C];if(z[D.id]===void 0)continue;let X=z[D.id];for(let G in X)h(X[G].object),delete X[G];delete z[D.id]}}}function S(D){for(let F in i){let H=i[F],C=D.isInstancedMesh===!0?D.id:0,z=H[C];if(z!==void 0){for(let X in z){let G=z[X];for(let et in G)h(G[et].object),delete G[et];delete z[X]}delete H[C],Object.keys(H).length===0&&delete i[F]}}}function U(){I(),o=!0,r!==n&&(r=n,c(r.object))}function I(){n.geometry=null,n.program=null,n.wireframe=!1}return{setup:a,reset:U,resetDefaultState:I,dispose:T,releaseStatesOfGeometry:A,releaseStatesOfObject:S,releaseStatesOfProgram:x,initAttributes:_,enableAttribute:m,disableUnusedAttributes:b}}function Ny(s,t,e){let i;function n(l){i=l}function r(l,c){s.drawArrays(i,l,c),e.update(c,i,1)}function o(l,c,h){h!==0&&(s.drawArraysInstanced(i,l,c,h),e.update(c,i,h))}function a(l,c,h){if(h===0)return;t.get("WEBGL_multi_draw").multiDrawArraysWEBGL(i,l,0,c,0,h);let d=0;for(let f=0;f<h;f++)d+=c[f];e.update(d,i,1)}this.setMode=n,this.render=r,this.renderInstances=o,this.renderMultiDraw=a}function Dy(s,t,e,i){let n;function r(){if(n!==void 0)return n;if(t.has("EXT_texture_filter_anisotropic")===!0){let x=t.get("EXT_texture_filter_anisotropic");n=s.getParameter(x.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else n=0;return n}function o(x){return!(x!==Ci&&i.convert(x)!==s.getParameter(s.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(x){let S=x===Ri&&(t.has("EXT_color_buffer_half_float")||t.has("EXT_color_buffer_float"));return!(x!==ii&&x!==xi&&!S&&i.convert(x)!==s.getParameter(s.IMPLEMENTATION_COLOR_READ_TYPE))}function l(x){if(x==="highp"){if(s.getShaderPrecisionFormat(s.VERTEX_SHADER,s.HIGH_FLOAT).precision>0&&s.getShaderPrecisionFormat(s.FRAGMENT_SHADER,s.HIGH_FLOAT).precision>0)return"highp";x="mediump"}return x==="mediump"&&s.getShaderPrecisionFormat(s.VERTEX_SHADER,s.MEDIUM_FLOAT).precision>0&&s.getShaderPrecisionFormat(s.FRAGMENT_SHADER,s.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=e.precision!==void 0?e.precision:"highp",h=l(c);h!==c&&(kt("WebGLRenderer:",c,"not supported, using",h,"instead."),c=h);let u=e.reversedDepthBuffer===!0&&t.has("EXT_clip_control"),d=e.logarithmicDepthBuffer===!0&&u===!1;e.reversedDepthBuffer===!0&&u===!1&&kt("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),e.logarithmicDepthBuffer===!0&&u===!0&&kt("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let f=s.getParameter(s.MAX_TEXTURE_IMAGE_UNITS),p=s.getParameter(s.MAX_VERTEX_TEXTURE_IMAGE_UNITS),_=s.getParameter(s.MAX_TEXTURE_SIZE),m=s.getParameter(s.MAX_CUBE_MAP_TEXTURE_SIZE),g=s.getParameter(s.MAX_VERTEX_ATTRIBS),b=s.getParameter(s.MAX_VERTEX_UNIFORM_VECTORS),E=s.getParameter(s.MAX_VARYING_VECTORS),M=s.getParameter(s.MAX_FRAGMENT_UNIFORM_VECTORS),T=s.getParameter(s.MAX_SAMPLES),A=s.getParameter(s.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:o,textureTypeReadable:a,precision:c,logarithmicDepthBuffer:d,reversedDepthBuffer:u,maxTextures:f,maxVertexTextures:p,maxTextureSize:_,maxCubemapSize:m,maxAttributes:g,maxVertexUniforms:b,maxVaryings:E,maxFragmentUniforms:M,maxSamples:T,samples:A}}function Uy(s){let t=this,e=null,i=0,n=!1,r=!1,o=new Ei,a=new Gt,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(u,d){let f=u.length!==0||d||i!==0||n;return n=d,i=u.length,f},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(u,d){e=h(u,d,0)},this.setState=function(u,d,f){let p=u.clippingPlanes,_=u.clipIntersection,m=u.clipShadows,g=s.get(u);if(!n||p===null||p.length===0||r&&!m)r?h(null):c();else{let b=r?0:i,E=b*4,M=g.clippingState||null;l.value=M,M=h(p,d,E,f);for(let T=0;T!==E;++T)M[T]=e[T];g.clippingState=M,this.numIntersection=_?this.numPlanes:0,this.numPlanes+=b}};function c(){l.value!==e&&(l.value=e,l.needsUpdate=i>0),t.numPlanes=i,t.numIntersection=0}function h(u,d,f,p){let _=u!==null?u.length:0,m=null;if(_!==0){if(m=l.value,p!==!0||m===null){let g=f+_*4,b=d.matrixWorldInverse;a.getNormalMatrix(b),(m===null||m.length<g)&&(m=new Float32Array(g));for(let E=0,M=f;E!==_;++E,M+=4)o.copy(u[E]).applyMatrix4(b,a),o.normal.toArray(m,M),m[M+3]=o.constant}l.value=m,l.needsUpdate=!0}return t.numPlanes=_,t.numIntersection=0,m}}var mo=class extends li{constructor(t=1,e={}){super(t,t,e),this.isWebGLCubeRenderTarget=!0;let i={width:t,height:t,depth:1},n=[i,i,i,i,i,i];this.texture=new Nr(n),this._setTextureOptions(e),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(t,e){this.texture.type=e.type,this.texture.colorSpace=e.colorSpace,this.texture.generateMipmaps=e.generateMipmaps,this.texture.minFilter=e.minFilter,this.texture.magFilter=e.magFilter;let i={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},n=new zi(5,5,5),r=new Me({name:"CubemapFromEquirect",uniforms:es(i.uniforms),vertexShader:i.vertexShader,fragmentShader:i.fragmentShader,side:ze,blending:jn});r.uniforms.tEquirect.value=e;let o=new Wt(n,r),a=e.minFilter;return e.minFilter===rn&&(e.minFilter=Je),new Os(1,10,this).update(t,o),e.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(t,e=!0,i=!0,n=!0){let r=t.getRenderTarget();for(let o=0;o<6;o++)t.setRenderTarget(this,o),t.clear(e,i,n);t.setRenderTarget(r)}},Gp=256,Oy=3,Fy=20,hm=256,um=16,ky=3,By=new L,zy=new Ct,Vs=class s{constructor(t){this._renderer=t,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new Os(1,10,null),this._boxMesh=new Wt(new zi(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(t,e=0,i=.1,n=100,r={}){let{size:o=256,position:a=By}=r,l=this._renderer;this._setSize(o);let c=this._allocateTarget(),h=this._getSourceTarget(!0);e>0&&(h.texture.mipmapsAutoUpdate=!1);let u=l.autoClear,d=l.autoClearColor,f=l.autoClearDepth,p=l.autoClearStencil,_=t.background;l.autoClear=!0,l.autoClearColor=!0,l.autoClearDepth=!0,l.autoClearStencil=!0,_===null&&(t.background=l.getClearColor(zy));let m=new Os(i,n,h);return m.position.copy(a),m.update(l,t),l.autoClear=u,l.autoClearColor=d,l.autoClearDepth=f,l.autoClearStencil=p,t.background=_,e>0&&(h.texture.mipmapsAutoUpdate=!0,this._blur(c,e)),this._applyPMREM(c),c}fromEquirectangular(t,e=null){return this._fromTexture(t,e)}fromCubemap(t,e=null){return this._fromTexture(t,e)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=Wp(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=Hp(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(t,e){return e>0?1-Math.sqrt(1-t/e):0}_setSize(t){this._cubeSize=Math.max(Gp,Ip(t))}_fromTexture(t,e){t.mapping===Qn||t.mapping===Bs?this._setSize(t.image.length===0?Gp:t.image[0].width||t.image[0].image.width):this._setSize(t.image.width/4);let i=e||this._allocateTarget();return this._textureToCubemap(t),this._applyPMREM(i),i}_allocateTarget(){let t=this._cubeSize,e=Vp(t,!1,!1),i=Math.log2(t)-Oy;for(let n=0;n<=i;n++)e.texture.mipmaps.push({width:t>>n,height:t>>n});return e.texture.name="PMREM",e.texture.isPMREMTexture=!0,e}_getSourceTarget(t=!1){let e=this._cubeSize,i=this._sourceTarget;return(i===null||i.width!==e||t&&i.depthBuffer===!1)&&(i!==null&&i.dispose(),this._sourceTarget=Vp(e,!0,t)),this._sourceTarget}_compileMaterial(t){this._boxMesh.material=t,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(t,e,i){let n=this._boxMesh,r=this._cubeCamera;n.material=i,r.renderTarget=t,r.activeMipmapLevel=e;let o=t.width>>e;t.viewport.set(0,0,o,o),r.update(this._renderer,n),t.viewport.set(0,0,t.width,t.height)}_textureToCubemap(t){let e;t.mapping===Qn||t.mapping===Bs?(this._cubemapMaterial===null&&(this._cubemapMaterial=Wp()),e=this._cubemapMaterial,e.uniforms.flipEnvMap.value=t.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=Hp()),e=this._equirectMaterial),e.uniforms.envMap.value=t,this._renderCube(this._getSourceTarget(),0,e)}_applyPMREM(t){this._ggxMaterial===null&&(this._ggxMaterial=Gy(),this._integrationMaterial=Vy());let e=this._cubeSize,i=t.texture.mipmaps.length-1,n=this._ggxMaterial.uniforms;n.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(e/um);for(let o=0;o<=i;o++){let a=s.lodToRoughness(o,i);if(o>i-ky)r.roughness.value=a,this._renderCube(t,o,this._integrationMaterial);else{let l=a>0?Math.log2(e)+.5*Math.log2(6/(hm*Math.pow(a,4)))+.5:0;n.roughness.value=a,n.lodBias.value=l,this._renderCube(t,o,this._ggxMaterial)}}}_blur(t,e){this._blurMaterial===null&&(this._blurMaterial=Hy());let i=this._blurMaterial,n=i.uniforms,r=this._sourceTarget;n.sigma.value=Math.min(e,Math.PI)/Math.SQRT2,n.envMap.value=r.texture,this._renderCube(t,0,i),n.envMap.value=t.texture,this._renderCube(r,0,i)}};function Vp(s,t,e){return new mo(s,{minFilter:rn,generateMipmaps:t,type:Ri,colorSpace:br,depthBuffer:e})}function go(s,t,e){return new Me({name:s,uniforms:t,vertexShader:Yt.cube_vert,fragmentShader:e,side:ze,blending:jn,depthTest:!1,depthWrite:!1})}function Gy(){return go("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${hm}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function Vy(){return go("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:um}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function Hy(){return go("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${Fy}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function Hp(){return go("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function Wp(){return go("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function Wy(s){let t=new WeakMap,e=new WeakMap,i=null;function n(d,f=!1){return d==null?null:f?o(d):r(d)}function r(d){if(d&&d.isTexture){let f=d.mapping;if(f===gl||f===xl)if(t.has(d)){let p=t.get(d).texture;return a(p,d.mapping)}else{let p=d.image;if(p&&p.height>0){let _=new mo(p.height);return _.fromEquirectangularTexture(s,d),t.set(d,_),d.addEventListener("dispose",c),a(_.texture,d.mapping)}else return null}}return d}function o(d){if(d&&d.isTexture&&d.isPMREMTexture!==!0){let f=d.mapping,p=f===gl||f===xl,_=f===Qn||f===Bs;if(p||_){let m=e.get(d),g=m!==void 0?m.texture.pmremVersion:0;if(d.isRenderTargetTexture&&d.pmremVersion!==g)return i===null&&(i=new Vs(s)),m=p?i.fromEquirectangular(d,m):i.fromCubemap(d,m),m.texture.pmremVersion=d.pmremVersion,e.set(d,m),m.texture;if(m!==void 0)return m.texture;{let b=d.image;return p&&b&&b.height>0||_&&b&&l(b)?(i===null&&(i=new Vs(s)),m=p?i.fromEquirectangular(d):i.fromCubemap(d),m.texture.pmremVersion=d.pmremVersion,e.set(d,m),d.addEventListener("dispose",h),m.texture):null}}}return d}function a(d,f){return f===gl?d.mapping=Qn:f===xl&&(d.mapping=Bs),d}function l(d){let f=0,p=6;for(let _=0;_<p;_++)d[_]!==void 0&&f++;return f===p}function c(d){let f=d.target;f.removeEventListener("dispose",c);let p=t.get(f);p!==void 0&&(t.delete(f),p.dispose())}function h(d){let f=d.target;f.removeEventListener("dispose",h);let p=e.get(f);p!==void 0&&(e.delete(f),p.dispose())}function u(){t=new WeakMap,e=new WeakMap,i!==null&&(i.dispose(),i=null)}return{get:n,dispose:u}}function Xy(s){let t={};function e(i){if(t[i]!==void 0)return t[i];let n=s.getExtension(i);return t[i]=n,n}return{has:function(i){return e(i)!==null},init:function(){e("EXT_color_buffer_float"),e("WEBGL_clip_cull_distance"),e("OES_texture_float_linear"),e("EXT_color_buffer_half_float"),e("WEBGL_multisampled_render_to_texture"),e("WEBGL_render_shared_exponent")},get:function(i){let n=e(i);return n===null&&xr("WebGLRenderer: "+i+" extension not supported."),n}}}function qy(s,t,e,i){let n={},r=new WeakMap,o=new FinalizationRegistry(p=>delete n[p]);function a(p){l(p.target)}function l(p){p.index!==null&&t.remove(p.index);for(let m in p.attributes)t.remove(p.attributes[m]);p.removeEventListener("dispose",a),delete n[p.id],o.unregister(p);let _=r.get(p);_&&(t.remove(_),r.delete(p)),i.releaseStatesOfGeometry(p),p.isInstancedBufferGeometry===!0&&delete p._maxInstanceCount,e.memory.geometries--}function c(p,_){return n[_.id]!==void 0||(_.addEventListener("dispose",a),n[_.id]=new WeakRef(_),o.register(_,_.id,_),e.memory.geometries++),_}function h(p){let _=p.attributes;for(let m in _)t.update(_[m],s.ARRAY_BUFFER)}function u(p){let _=p.index,m=p.attributes.position,g=0;if(m===void 0)return;let b=_!==null?_.array.length:m.array.length/3-1,E=m.count>=65535?Tr:Ar,M=new E(Math.ceil(b/3)*6,1),T=M.array;if(_!==null){let x=_.array;g=_.version;for(let S=0,U=0;S<b;S+=3){let I=x[S+0],D=x[S+1],F=x[S+2];T[U++]=I,T[U++]=D,T[U++]=D,T[U++]=F,T[U++]=F,T[U++]=I}}else{g=m.version;for(let x=0,S=0;x<b;x+=3){let U=x+0,I=x+1,D=x+2;T[S++]=U,T[S++]=I,T[S++]=I,T[S++]=D,T[S++]=D,T[S++]=U}}M.version=g;let A=r.get(p);A&&t.remove(A),r.set(p,M)}function d(p){let _=r.get(p);if(_){let m=p.index;m!==null&&_.version<m.version&&u(p)}else u(p);return r.get(p)}function f(){for(let p in n){let _=n[p].deref();_!==void 0&&l(_)}}return{get:c,update:h,getWireframeAttribute:d,dispose:f}}function $y(s,t,e){let i;function n(u){i=u}let r,o;function a(u){r=u.type,o=u.bytesPerElement}function l(u,d){s.drawElements(i,d,r,u*o),e.update(d,i,1)}function c(u,d,f){f!==0&&(s.drawElementsInstanced(i,d,r,u*o,f),e.update(d,i,f))}function h(u,d,f){if(f===0)return;t.get("WEBGL_multi_draw").multiDrawElementsWEBGL(i,d,0,r,u,0,f);let _=0;for(let m=0;m<f;m++)_+=d[m];e.update(_,i,1)}this.setMode=n,this.setIndex=a,this.render=l,this.renderInstances=c,this.renderMultiDraw=h}function Yy(s){let t={geometries:0,textures:0},e={frame:0,calls:0,triangles:0,points:0,lines:0};function i(r,o,a){switch(e.calls++,o){case s.TRIANGLES:e.triangles+=a*(r/3);break;case s.LINES:e.lines+=a*(r/2);break;case s.LINE_STRIP:e.lines+=a*(r-1);break;case s.LINE_LOOP:e.lines+=a*r;break;case s.POINTS:e.points+=a*r;break;default:Bt("WebGLInfo: Unknown draw mode:",o);break}}function n(){e.calls=0,e.triangles=0,e.points=0,e.lines=0}return{memory:t,render:e,programs:null,autoReset:!0,reset:n,update:i}}function Zy(s,t,e){let i=new WeakMap,n=new fe;function r(o,a,l){let c=o.morphTargetInfluences,h=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,u=h!==void 0?h.length:0,d=i.get(a);if(d===void 0||d.count!==u){let U=function(){x.dispose(),i.delete(a),a.removeEventListener("dispose",U)};d!==void 0&&d.texture.dispose();let f=a.morphAttributes.position!==void 0,p=a.morphAttributes.normal!==void 0,_=a.morphAttributes.color!==void 0,m=a.morphAttributes.position||[],g=a.morphAttributes.normal||[],b=a.morphAttributes.color||[],E=0;f===!0&&(E=1),p===!0&&(E=2),_===!0&&(E=3);let M=a.attributes.position.count*E,T=1;M>t.maxTextureSize&&(T=Math.ceil(M/t.maxTextureSize),M=t.maxTextureSize);let A=new Float32Array(M*T*4*u),x=new Er(A,M,T,u);x.type=xi,x.needsUpdate=!0;let S=E*4;for(let I=0;I<u;I++){let D=m[I],F=g[I],H=b[I],C=M*T*4*I;for(let z=0;z<D.count;z++){let X=z*S;f===!0&&(n.fromBufferAttribute(D,z),A[C+X+0]=n.x,A[C+X+1]=n.y,A[C+X+2]=n.z,A[C+X+3]=0),p===!0&&(n.fromBufferAttribute(F,z),A[C+X+4]=n.x,A[C+X+5]=n.y,A[C+X+6]=n.z,A[C+X+7]=0),_===!0&&(n.fromBufferAttribute(H,z),A[C+X+8]=n.x,A[C+X+9]=n.y,A[C+X+10]=n.z,A[C+X+11]=H.itemSize===4?n.w:1)}}d={count:u,texture:x,size:new lt(M,T)},i.set(a,d),a.addEventListener("dispose",U)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)l.getUniforms().setValue(s,"morphTexture",o.morphTexture,e);else{let f=0;for(let _=0;_<c.length;_++)f+=c[_];let p=a.morphTargetsRelative?1:1-f;l.getUniforms().setValue(s,"morphTargetBaseInfluence",p),l.getUniforms().setValue(s,"morphTargetInfluences",c)}l.getUniforms().setValue(s,"morphTargetsTexture",d.texture,e),l.getUniforms().setValue(s,"morphTargetsTextureSize",d.size)}return{update:r}}function Jy(s,t,e,i,n){let r=new WeakMap;function o(c){let h=n.render.frame,u=c.geometry,d=t.get(c,u);if(r.get(d)!==h&&(t.update(d),r.set(d,h)),c.isInstancedMesh&&(c.hasEventListener("dispose",l)===!1&&c.addEventListener("dispose",l),r.get(c)!==h&&(e.update(c.instanceMatrix,s.ARRAY_BUFFER),c.instanceColor!==null&&e.update(c.instanceColor,s.ARRAY_BUFFER),r.set(c,h))),c.isSkinnedMesh){let f=c.skeleton;r.get(f)!==h&&(f.update(),r.set(f,h))}return d}function a(){r=new WeakMap}function l(c){let h=c.target;h.removeEventListener("dispose",l),i.releaseStatesOfObject(h),e.remove(h.instanceMatrix),h.instanceColor!==null&&e.remove(h.instanceColor)}return{update:o,dispose:a}}var jy={[tu]:"LINEAR_TONE_MAPPING",[eu]:"REINHARD_TONE_MAPPING",[iu]:"CINEON_TONE_MAPPING",[nu]:"ACES_FILMIC_TONE_MAPPING",[ru]:"AGX_TONE_MAPPING",[ou]:"NEUTRAL_TONE_MAPPING",[su]:"CUSTOM_TONE_MAPPING"};function Ky(s,t,e,i,n,r){let o=new li(t,e,{type:s,depthBuffer:n,stencilBuffer:r,samples:i?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,l=null,c=null,h=new _e;h.setAttribute("position",new qt([-1,3,0,-1,-1,0,3,-1,0],3)),h.setAttribute("uv",new qt([0,2,0,0,2,0],2));let u=new tl({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),d=new Wt(h,u),f=new to(-1,1,1,-1,0,1),p=null,_=null,m=!1,g,b=null,E=[],M=!1;this.setSize=function(T,A){o.setSize(T,A),a!==null&&a.setSize(T,A),l!==null&&l.setSize(T,A);for(let x=0;x<E.length;x++){let S=E[x];S.setSize&&S.setSize(T,A)}},this.setEffects=function(T){E=T,M=E.length>0&&E[0].isRenderPass===!0;let A=o.width,x=o.height;E.length>0&&a===null&&(a=new li(A,x,{type:Ri,depthBuffer:!1,stencilBuffer:!1}),l=new li(A,x,{type:Ri,depthBuffer:!1,stencilBuffer:!1}));let S=n===!0&&E.some(U=>U.needsDepthTexture===!0);S!==(o.depthTexture!==null)&&(S===!0&&c===null&&(c=new nn(A,x),r===!0&&(c.format=on,c.type=ts)),o.dispose(),o.depthTexture=S?c:null,o.resolveDepthBuffer=S,o.storeMultisampledDepthBuffer=S);for(let U=0;U<E.length;U++){let I=E[U];I.setSize&&I.setSize(A,x),S&&I.needsDepthTexture===!0&&I.setDepthTexture&&I.setDepthTexture(c)}},this.begin=function(T,A){if(m||T.toneMapping===Gi&&E.length===0)return!1;if(b=A,A!==null){let x=A.width,S=A.height;(o.width!==x||o.height!==S)&&this.setSize(x,S)}return M===!1&&T.setRenderTarget(o),g=T.toneMapping,T.toneMapping=Gi,!0},this.hasRenderPass=function(){return M},this.end=function(T,A){T.toneMapping=g,m=!0;let x=o,S=a;for(let U=0;U<E.length;U++){let I=E[U];I.enabled!==!1&&(I.render(T,S,x,A),I.needsSwap!==!1&&(x=S,S=S===a?l:a))}if(p!==T.outputColorSpace||_!==T.toneMapping){p=T.outputColorSpace,_=T.toneMapping,u.defines={},ne.getTransfer(p)===le&&(u.defines.SRGB_TRANSFER="");let U=jy[_];U&&(u.defines[U]=""),u.needsUpdate=!0}u.uniforms.tDiffuse.value=x.texture,T.setRenderTarget(b),T.render(d,f),b=null,m=!1},this.isCompositing=function(){return m},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),l!==null&&l.dispose(),h.dispose(),u.dispose()}}var dm=new ei,fm=new nn(1,1),pm=new Dr(1),mm=new Er,gm=new Va,xm=new Nr,Xp=[],qp=[],$p=new Float32Array(16),Yp=new Float32Array(9),Zp=new Float32Array(4);function Hs(s,t,e){let i=s[0];if(i<=0||i>0)return s;let n=t*e,r=Xp[n];if(r===void 0&&(r=new Float32Array(n),Xp[n]=r),t!==0){i.toArray(r,0);for(let o=1,a=0;o!==t;++o)a+=e,s[o].toArray(r,a)}return r}function Pe(s,t){if(s.length!==t.length)return!1;for(let e=0,i=s.length;e<i;e++)if(s[e]!==t[e])return!1;return!0}function Le(s,t){for(let e=0,i=t.length;e<i;e++)s[e]=t[e]}function oc(s,t){let e=qp[t];e===void 0&&(e=new Int32Array(t),qp[t]=e);for(let i=0;i!==t;++i)e[i]=s.allocateTextureUnit();return e}function Qy(s,t){let e=this.cache;e[0]!==t&&(s.uniform1f(this.addr,t),e[0]=t)}function tb(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(s.uniform2f(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Pe(e,t))return;s.uniform2fv(this.addr,t),Le(e,t)}}function eb(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(s.uniform3f(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else if(t.r!==void 0)(e[0]!==t.r||e[1]!==t.g||e[2]!==t.b)&&(s.uniform3f(this.addr,t.r,t.g,t.b),e[0]=t.r,e[1]=t.g,e[2]=t.b);else{if(Pe(e,t))return;s.uniform3fv(this.addr,t),Le(e,t)}}function ib(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(s.uniform4f(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Pe(e,t))return;s.uniform4fv(this.addr,t),Le(e,t)}}function nb(s,t){let e=this.cache,i=t.elements;if(i===void 0){if(Pe(e,t))return;s.uniformMatrix2fv(this.addr,!1,t),Le(e,t)}else{if(Pe(e,i))return;Zp.set(i),s.uniformMatrix2fv(this.addr,!1,Zp),Le(e,i)}}function sb(s,t){let e=this.cache,i=t.elements;if(i===void 0){if(Pe(e,t))return;s.uniformMatrix3fv(this.addr,!1,t),Le(e,t)}else{if(Pe(e,i))return;Yp.set(i),s.uniformMatrix3fv(this.addr,!1,Yp),Le(e,i)}}function rb(s,t){let e=this.cache,i=t.elements;if(i===void 0){if(Pe(e,t))return;s.uniformMatrix4fv(this.addr,!1,t),Le(e,t)}else{if(Pe(e,i))return;$p.set(i),s.uniformMatrix4fv(this.addr,!1,$p),Le(e,i)}}function ob(s,t){let e=this.cache;e[0]!==t&&(s.uniform1i(this.addr,t),e[0]=t)}function ab(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(s.uniform2i(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Pe(e,t))return;s.uniform2iv(this.addr,t),Le(e,t)}}function lb(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(s.uniform3i(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(Pe(e,t))return;s.uniform3iv(this.addr,t),Le(e,t)}}function cb(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(s.uniform4i(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Pe(e,t))return;s.uniform4iv(this.addr,t),Le(e,t)}}function hb(s,t){let e=this.cache;e[0]!==t&&(s.uniform1ui(this.addr,t),e[0]=t)}function ub(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(s.uniform2ui(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Pe(e,t))return;s.uniform2uiv(this.addr,t),Le(e,t)}}function db(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(s.uniform3ui(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(Pe(e,t))return;s.uniform3uiv(this.addr,t),Le(e,t)}}function fb(s,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(s.uniform4ui(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Pe(e,t))return;s.uniform4uiv(this.addr,t),Le(e,t)}}function ac(s){return s.version===0&&(s.compareFunction=gu,s.needsUpdate=!0),s}function pb(s,t,e){let i=this.cache,n=e.allocateTextureUnit();i[0]!==n&&(s.uniform1i(this.addr,n),i[0]=n);let r;this.type===s.SAMPLER_2D_SHADOW?r=ac(fm):r=dm,e.setTexture2D(t||r,n)}function mb(s,t,e){let i=this.cache,n=e.allocateTextureUnit();i[0]!==n&&(s.uniform1i(this.addr,n),i[0]=n),e.setTexture3D(t||gm,n)}function gb(s,t,e){let i=this.cache,n=e.allocateTextureUnit();i[0]!==n&&(s.uniform1i(this.addr,n),i[0]=n);let r;this.type===s.SAMPLER_CUBE_SHADOW?r=ac(pm):r=xm,e.setTextureCube(t||r,n)}function xb(s,t,e){let i=this.cache,n=e.allocateTextureUnit();i[0]!==n&&(s.uniform1i(this.addr,n),i[0]=n),e.setTexture2DArray(t||mm,n)}function _b(s){switch(s){case 5126:return Qy;case 35664:return tb;case 35665:return eb;case 35666:return ib;case 35674:return nb;case 35675:return sb;case 35676:return rb;case 5124:case 35670:return ob;case 35667:case 35671:return ab;case 35668:case 35672:return lb;case 35669:case 35673:return cb;case 5125:return hb;case 36294:return ub;case 36295:return db;case 36296:return fb;case 35678:case 36198:case 36298:case 36306:case 35682:return pb;case 35679:case 36299:case 36307:return mb;case 35680:case 36300:case 36308:case 36293:return gb;case 36289:case 36303:case 36311:case 36292:return xb}}function vb(s,t){s.uniform1fv(this.addr,t)}function yb(s,t){let e=Hs(t,this.size,2);s.uniform2fv(this.addr,e)}function bb(s,t){let e=Hs(t,this.size,3);s.uniform3fv(this.addr,e)}function Mb(s,t){let e=Hs(t,this.size,4);s.uniform4fv(this.addr,e)}function Sb(s,t){let e=Hs(t,this.size,4);s.uniformMatrix2fv(this.addr,!1,e)}function wb(s,t){let e=Hs(t,this.size,9);s.uniformMatrix3fv(this.addr,!1,e)}function Eb(s,t){let e=Hs(t,this.size,16);s.uniformMatrix4fv(this.addr,!1,e)}function Ab(s,t){s.uniform1iv(this.addr,t)}function Tb(s,t){s.uniform2iv(this.addr,t)}function Rb(s,t){s.uniform3iv(this.addr,t)}function Cb(s,t){s.uniform4iv(this.addr,t)}function Ib(s,t){s.uniform1uiv(this.addr,t)}function Pb(s,t){s.uniform2uiv(this.addr,t)}function Lb(s,t){s.uniform3uiv(this.addr,t)}function Nb(s,t){s.uniform4uiv(this.addr,t)}function Db(s,t,e){let i=this.cache,n=t.length,r=oc(e,n);Pe(i,r)||(s.uniform1iv(this.addr,r),Le(i,r));let o;this.type===s.SAMPLER_2D_SHADOW?o=ac(fm):o=dm;for(let a=0;a!==n;++a)e.setTexture2D(t[a]||o,r[a])}function Ub(s,t,e){let i=this.cache,n=t.length,r=oc(e,n);Pe(i,r)||(s.uniform1iv(this.addr,r),Le(i,r));for(let o=0;o!==n;++o)e.setTexture3D(t[o]||gm,r[o])}function Ob(s,t,e){let i=this.cache,n=t.length,r=oc(e,n);Pe(i,r)||(s.uniform1iv(this.addr,r),Le(i,r));let o;this.type===s.SAMPLER_CUBE_SHADOW?o=ac(pm):o=xm;for(let a=0;a!==n;++a)e.setTextureCube(t[a]||o,r[a])}function Fb(s,t,e){let i=this.cache,n=t.length,r=oc(e,n);Pe(i,r)||(s.uniform1iv(this.addr,r),Le(i,r));for(let o=0;o!==n;++o)e.setTexture2DArray(t[o]||mm,r[o])}function kb(s){switch(s){case 5126:return vb;case 35664:return yb;case 35665:return bb;case 35666:return Mb;case 35674:return Sb;case 35675:return wb;case 35676:return Eb;case 5124:case 35670:return Ab;case 35667:case 35671:return Tb;case 35668:case 35672:return Rb;case 35669:case 35673:return Cb;case 5125:return Ib;case 36294:return Pb;case 36295:return Lb;case 36296:return Nb;case 35678:case 36198:case 36298:case 36306:case 35682:return Db;case 35679:case 36299:case 36307:return Ub;case 35680:case 36300:case 36308:case 36293:return Ob;case 36289:case 36303:case 36311:case 36292:return Fb}}var Pu=class{constructor(t,e,i){this.id=t,this.addr=i,this.cache=[],this.type=e.type,this.setValue=_b(e.type)}},Lu=class{constructor(t,e,i){this.id=t,this.addr=i,this.cache=[],this.type=e.type,this.size=e.size,this.setValue=kb(e.type)}},Nu=class{constructor(t){this.id=t,this.seq=[],this.map={}}setValue(t,e,i){let n=this.seq;for(let r=0,o=n.length;r!==o;++r){let a=n[r];a.setValue(t,e[a.id],i)}}},Cu=/(\w+)(\])?(\[|\.)?/g;function Jp(s,t){s.seq.push(t),s.map[t.id]=t}function Bb(s,t,e){let i=s.name,n=i.length;for(Cu.lastIndex=0;;){let r=Cu.exec(i),o=Cu.lastIndex,a=r[1],l=r[2]==="]",c=r[3];if(l&&(a=a|0),c===void 0||c==="["&&o+2===n){Jp(e,c===void 0?new Pu(a,s,t):new Lu(a,s,t));break}else{let u=e.map[a];u===void 0&&(u=new Nu(a),Jp(e,u)),e=u}}}var Gs=class{constructor(t,e){this.seq=[],this.map={};let i=t.getProgramParameter(e,t.ACTIVE_UNIFORMS);for(let o=0;o<i;++o){let a=t.getActiveUniform(e,o),l=t.getUniformLocation(e,a.name);Bb(a,l,this)}let n=[],r=[];for(let o of this.seq)o.type===t.SAMPLER_2D_SHADOW||o.type===t.SAMPLER_CUBE_SHADOW||o.type===t.SAMPLER_2D_ARRAY_SHADOW?n.push(o):r.push(o);n.length>0&&(this.seq=n.concat(r))}setValue(t,e,i,n){let r=this.map[e];r!==void 0&&r.setValue(t,i,n)}setOptional(t,e,i){let n=e[i];n!==void 0&&this.setValue(t,i,n)}static upload(t,e,i,n){for(let r=0,o=e.length;r!==o;++r){let a=e[r],l=i[a.id];l.needsUpdate!==!1&&a.setValue(t,l.value,n)}}static seqWithValue(t,e){let i=[];for(let n=0,r=t.length;n!==r;++n){let o=t[n];o.id in e&&i.push(o)}return i}};function jp(s,t,e){let i=s.createShader(t);return s.shaderSource(i,e),s.compileShader(i),i}var zb=37297,Gb=0;function Vb(s,t){let e=s.split(`
`),i=[],n=Math.max(t-6,0),r=Math.min(t+6,e.length);for(let o=n;o<r;o++){let a=o+1;i.push(`${a===t?">":" "} ${a}: ${e[o]}`)}return i.join(`
`)}var Kp=new Gt;function Hb(s){ne._getMatrix(Kp,ne.workingColorSpace,s);let t=`mat3( ${Kp.elements.map(e=>e.toFixed(4))} )`;switch(ne.getTransfer(s)){case Mr:return[t,"LinearTransferOETF"];case le:return[t,"sRGBTransferOETF"];default:return kt("WebGLProgram: Unsupported color space: ",s),[t,"LinearTransferOETF"]}}function Qp(s,t,e){let i=s.getShaderParameter(t,s.COMPILE_STATUS),r=(s.getShaderInfoLog(t)||"").trim();if(i&&r==="")return"";let o=/ERROR: 0:(\d+)/.exec(r);if(o){let a=parseInt(o[1]);return e.toUpperCase()+`

`+r+`

`+Vb(s.getShaderSource(t),a)}else return r}function Wb(s,t){let e=Hb(t);return[`vec4 ${s}( vec4 value ) {`,`	return ${e[1]}( vec4( ${e[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var Xb={[tu]:"Linear",[eu]:"Reinhard",[iu]:"Cineon",[nu]:"ACESFilmic",[ru]:"AgX",[ou]:"Neutral",[su]:"Custom"};function qb(s,t){let e=Xb[t];return e===void 0?(kt("WebGLProgram: Unsupported toneMapping:",t),"vec3 "+s+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+s+"( vec3 color ) { return "+e+"ToneMapping( color ); }"}var sc=new L;function $b(){ne.getLuminanceCoefficients(sc);let s=sc.x.toFixed(4),t=sc.y.toFixed(4),e=sc.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${s}, ${t}, ${e} );`,"	return dot( weights, rgb );","}"].join(`
`)}function Yb(s){return[s.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",s.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(po).join(`
`)}function Zb(s){let t=[];for(let e in s){let i=s[e];i!==!1&&t.push("#define "+e+" "+i)}return t.join(`
`)}function Jb(s,t){let e={},i=s.getProgramParameter(t,s.ACTIVE_ATTRIBUTES);for(let n=0;n<i;n++){let r=s.getActiveAttrib(t,n),o=r.name,a=1;r.type===s.FLOAT_MAT2&&(a=2),r.type===s.FLOAT_MAT3&&(a=3),r.type===s.FLOAT_MAT4&&(a=4),e[o]={type:r.type,location:s.getAttribLocation(t,o),locationSize:a}}return e}function po(s){return s!==""}function tm(s,t){let e=t.numSpotLightShadows+t.numSpotLightMaps-t.numSpotLightShadowsWithMaps;return s.replace(/NUM_SUN_LIGHTS/g,t.numSunLights).replace(/NUM_DIR_LIGHTS/g,t.numDirLights).replace(/NUM_SPOT_LIGHTS/g,t.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,t.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,e).replace(/NUM_RECT_AREA_LIGHTS/g,t.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,t.numPointLights).replace(/NUM_HEMI_LIGHTS/g,t.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,t.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,t.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,t.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,t.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,t.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,t.numLightProbeGrids)}function em(s,t){return s.replace(/NUM_CLIPPING_PLANES/g,t.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,t.numClippingPlanes-t.numClipIntersection)}var jb=/^[ \t]*#include +<([\w\d./]+)>/gm;function Du(s){return s.replace(jb,Kb)}function Kb(s,t){let e=Yt[t];if(e===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+t+">");return Du(e)}var Qb=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function im(s){return s.replace(Qb,tM)}function tM(s,t,e,i){let n="";for(let r=parseInt(t);r<parseInt(e);r++)n+=i.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return n}function nm(s){let t=`precision ${s.precision} float;
	precision ${s.precision} int;
	precision ${s.precision} sampler2D;
	precision ${s.precision} samplerCube;
	precision ${s.precision} sampler3D;
	precision ${s.precision} sampler2DArray;
	precision ${s.precision} sampler2DShadow;
	precision ${s.precision} samplerCubeShadow;
	precision ${s.precision} sampler2DArrayShadow;
	precision ${s.precision} isampler2D;
	precision ${s.precision} isampler3D;
	precision ${s.precision} isamplerCube;
	precision ${s.precision} isampler2DArray;
	precision ${s.precision} usampler2D;
	precision ${s.precision} usampler3D;
	precision ${s.precision} usamplerCube;
	precision ${s.precision} usampler2DArray;
	`;return s.precision==="highp"?t+=`
#define HIGH_PRECISION`:s.precision==="mediump"?t+=`
#define MEDIUM_PRECISION`:s.precision==="lowp"&&(t+=`
#define LOW_PRECISION`),t}var eM={[Jn]:"SHADOWMAP_TYPE_PCF",[Fs]:"SHADOWMAP_TYPE_VSM"};function iM(s){return eM[s.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var nM={[Bs]:"ENVMAP_MODE_REFRACTION"};function sM(s){return s.envMap===!1?"ENVMAP_MODE_REFLECTION":nM[s.envMapMode]||"ENVMAP_MODE_REFLECTION"}var rM={[ml]:"ENVMAP_BLENDING_MULTIPLY",[mp]:"ENVMAP_BLENDING_MIX",[gp]:"ENVMAP_BLENDING_ADD"};function oM(s){return s.envMap===!1?"ENVMAP_BLENDING_NONE":rM[s.combine]||"ENVMAP_BLENDING_NONE"}function aM(s,t,e,i){let n=s.getContext(),r=e.defines,o=e.vertexShader,a=e.fragmentShader,l=iM(e),c=e.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",h=sM(e),u=oM(e),d=Yb(e),f=Zb(r),p=n.createProgram(),_,m,g=e.glslVersion?"#version "+e.glslVersion+`
`:"";e.isRawShaderMaterial?(_=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f].filter(po).join(`
`),_.length>0&&(_+=`
`),m=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f].filter(po).join(`
`),m.length>0&&(m+=`
`)):(_=[nm(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f,e.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",e.batching?"#define USE_BATCHING":"",e.batchingColor?"#define USE_BATCHING_COLOR":"",e.instancing?"#define USE_INSTANCING":"",e.instancingColor?"#define USE_INSTANCING_COLOR":"",e.instancingMorph?"#define USE_INSTANCING_MORPH":"",e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.map?"#define USE_MAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+h:"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.displacementMap?"#define USE_DISPLACEMENTMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.mapUv?"#define MAP_UV "+e.mapUv:"",e.alphaMapUv?"#define ALPHAMAP_UV "+e.alphaMapUv:"",e.lightMapUv?"#define LIGHTMAP_UV "+e.lightMapUv:"",e.aoMapUv?"#define AOMAP_UV "+e.aoMapUv:"",e.emissiveMapUv?"#define EMISSIVEMAP_UV "+e.emissiveMapUv:"",e.bumpMapUv?"#define BUMPMAP_UV "+e.bumpMapUv:"",e.normalMapUv?"#define NORMALMAP_UV "+e.normalMapUv:"",e.displacementMapUv?"#define DISPLACEMENTMAP_UV "+e.displacementMapUv:"",e.metalnessMapUv?"#define METALNESSMAP_UV "+e.metalnessMapUv:"",e.roughnessMapUv?"#define ROUGHNESSMAP_UV "+e.roughnessMapUv:"",e.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+e.anisotropyMapUv:"",e.clearcoatMapUv?"#define CLEARCOATMAP_UV "+e.clearcoatMapUv:"",e.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+e.clearcoatNormalMapUv:"",e.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+e.clearcoatRoughnessMapUv:"",e.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+e.diffuseRoughnessMapUv:"",e.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+e.iridescenceMapUv:"",e.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+e.iridescenceThicknessMapUv:"",e.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+e.sheenColorMapUv:"",e.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+e.sheenRoughnessMapUv:"",e.specularMapUv?"#define SPECULARMAP_UV "+e.specularMapUv:"",e.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+e.specularColorMapUv:"",e.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+e.specularIntensityMapUv:"",e.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+e.transmissionMapUv:"",e.thicknessMapUv?"#define THICKNESSMAP_UV "+e.thicknessMapUv:"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexNormals?"#define HAS_NORMAL":"",e.vertexColors?"#define USE_COLOR":"",e.vertexAlphas?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.flatShading?"#define FLAT_SHADED":"",e.skinning?"#define USE_SKINNING":"",e.morphTargets?"#define USE_MORPHTARGETS":"",e.morphNormals&&e.flatShading===!1?"#define USE_MORPHNORMALS":"",e.morphColors?"#define USE_MORPHCOLORS":"",e.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+e.morphTextureStride:"",e.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+e.morphTargetsCount:"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.sizeAttenuation?"#define USE_SIZEATTENUATION":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(po).join(`
`),m=[nm(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f,e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",e.map?"#define USE_MAP":"",e.matcap?"#define USE_MATCAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+c:"",e.envMap?"#define "+h:"",e.envMap?"#define "+u:"",e.envMapPMREM?"#define ENVMAP_MAX_LOD "+e.envMapMaxLod+".0":"",e.envMapPMREM?"#define ENVMAP_SIZE "+e.envMapSize+".0":"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoat?"#define USE_CLEARCOAT":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.dispersion?"#define USE_DISPERSION":"",e.retroreflection?"#define USE_RETROREFLECTION":"",e.iridescence?"#define USE_IRIDESCENCE":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaTest?"#define USE_ALPHATEST":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.sheen?"#define USE_SHEEN":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexColors||e.instancingColor?"#define USE_COLOR":"",e.vertexAlphas||e.batchingColor?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.gradientMap?"#define USE_GRADIENTMAP":"",e.flatShading?"#define FLAT_SHADED":"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",e.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",e.toneMapping!==Gi?"#define TONE_MAPPING":"",e.toneMapping!==Gi?Yt.tonemapping_pars_fragment:"",e.toneMapping!==Gi?qb("toneMapping",e.toneMapping):"",e.dithering?"#define DITHERING":"",e.opaque?"#define OPAQUE":"",Yt.colorspace_pars_fragment,Wb("linearToOutputTexel",e.outputColorSpace),$b(),e.useDepthPacking?"#define DEPTH_PACKING "+e.depthPacking:"",`
`].filter(po).join(`
`)),o=Du(o),o=tm(o,e),o=em(o,e),a=Du(a),a=tm(a,e),a=em(a,e),o=im(o),a=im(a),e.isRawShaderMaterial!==!0&&(g=`#version 300 es
`,_=[d,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+_,m=["#define varying in",e.glslVersion===_u?"":"layout(location = 0) out highp vec4 pc_fragColor;",e.glslVersion===_u?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+m);let b=g+_+o,E=g+m+a,M=jp(n,n.VERTEX_SHADER,b),T=jp(n,n.FRAGMENT_SHADER,E);n.attachShader(p,M),n.attachShader(p,T),e.index0AttributeName!==void 0?n.bindAttribLocation(p,0,e.index0AttributeName):e.hasPositionAttribute===!0&&n.bindAttribLocation(p,0,"position"),n.linkProgram(p);function A(I){if(s.debug.checkShaderErrors){let D=n.getProgramInfoLog(p)||"",F=n.getShaderInfoLog(M)||"",H=n.getShaderInfoLog(T)||"",C=D.trim(),z=F.trim(),X=H.trim(),G=!0,et=!0;if(n.getProgramParameter(p,n.LINK_STATUS)===!1)if(G=!1,typeof s.debug.onShaderError=="function")s.debug.onShaderError(n,p,M,T);else{let W=Qp(n,M,"vertex"),K=Qp(n,T,"fragment");Bt("WebGLProgram: Shader Error "+n.getError()+" - VALIDATE_STATUS "+n.getProgramParameter(p,n.VALIDATE_STATUS)+`

Material Name: `+I.name+`
Material Type: `+I.type+`

Program Info Log: `+C+`
`+W+`
`+K)}else C!==""?kt("WebGLProgram: Program Info Log:",C):(z===""||X==="")&&(et=!1);et&&(I.diagnostics={runnable:G,programLog:C,vertexShader:{log:z,prefix:_},fragmentShader:{log:X,prefix:m}})}n.deleteShader(M),n.deleteShader(T),x=new Gs(n,p),S=Jb(n,p)}let x;this.getUniforms=function(){return x===void 0&&A(this),x};let S;this.getAttributes=function(){return S===void 0&&A(this),S};let U=e.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return U===!1&&(U=n.getProgramParameter(p,zb)),U},this.destroy=function(){i.releaseStatesOfProgram(this),n.deleteProgram(p),this.program=void 0},this.type=e.shaderType,this.name=e.shaderName,this.id=Gb++,this.cacheKey=t,this.usedTimes=1,this.program=p,this.vertexShader=M,this.fragmentShader=T,this}var lM=0,Uu=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(t,e,i){let n=this._getShaderCacheForMaterial(t);return n.has(e)===!1&&(n.add(e),e.usedTimes++),n.has(i)===!1&&(n.add(i),i.usedTimes++),this}remove(t){let e=this.materialCache.get(t);for(let i of e)i.usedTimes--,i.usedTimes===0&&this.shaderCache.delete(i.code);return this.materialCache.delete(t),this}getVertexShaderStage(t){return this._getShaderStage(t.vertexShader)}getFragmentShaderStage(t){return this._getShaderStage(t.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(t){let e=this.materialCache,i=e.get(t);return i===void 0&&(i=new Set,e.set(t,i)),i}_getShaderStage(t){let e=this.shaderCache,i=e.get(t);return i===void 0&&(i=new Ou(t),e.set(t,i)),i}},Ou=class{constructor(t){this.id=lM++,this.code=t,this.usedTimes=0}};function cM(s){return s===Cn||s===co||s===ho}function hM(s,t,e,i,n,r){let o=new As,a=new Uu,l=new Set,c=[],h=new Map,u=i.logarithmicDepthBuffer,d={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function f(x){return l.add(x),x===0?"uv":`uv${x}`}function p(x,S,U,I,D,F){let H=I.fog,C=D.geometry,z=x.isMeshStandardMaterial||x.isMeshLambertMaterial||x.isMeshPhongMaterial?I.environment:null,X=x.isMeshStandardMaterial||x.isMeshLambertMaterial&&!x.envMap||x.isMeshPhongMaterial&&!x.envMap,G=t.get(x.envMap||z,X),et=d[x.type],W=i.precision;x.precision!==null&&(W=i.getMaxPrecision(x.precision),W!==x.precision&&kt("WebGLProgram.getParameters:",x.precision,"not supported, using",W,"instead."));let K=C.morphAttributes.position||C.morphAttributes.normal||C.morphAttributes.color,tt=K!==void 0?K.length:0,St=0;C.morphAttributes.position!==void 0&&(St=1),C.morphAttributes.normal!==void 0&&(St=2),C.morphAttributes.color!==void 0&&(St=3);let Ot,$,xt,wt;if(et){let vt=Hi[et];Ot=vt.vertexShader,$=vt.fragmentShader}else{Ot=x.vertexShader,$=x.fragmentShader;let vt=a.getVertexShaderStage(x),ce=a.getFragmentShaderStage(x);a.update(x,vt,ce),xt=vt.id,wt=ce.id}let Nt=s.getRenderTarget(),_t=s.state.buffers.depth.getReversed(),Dt=D.isInstancedMesh===!0,pe=D.isBatchedMesh===!0,Ft=!!x.map,Zt=!!x.matcap,jt=!!G,Q=jt&&G.isPMREMTexture===!0,ct=!!x.aoMap,rt=!!x.lightMap,Mt=!!x.bumpMap&&x.wireframe===!1,gt=!!x.normalMap,Ht=!!x.displacementMap,It=!!x.emissiveMap,Kt=!!x.metalnessMap,te=!!x.roughnessMap,oe=x.anisotropy>0,N=x.clearcoat>0,Ee=x.diffuseRoughness>0,Jt=x.dispersion>0,he=x.retroreflectivity>0,ft=x.iridescence>0,ve=x.sheen>0,Ut=x.transmission>0,zt=oe&&!!x.anisotropyMap,w=N&&!!x.clearcoatMap,v=N&&!!x.clearcoatNormalMap,k=N&&!!x.clearcoatRoughnessMap,it=Ee&&!!x.diffuseRoughnessMap,j=ft&&!!x.iridescenceMap,ot=ft&&!!x.iridescenceThicknessMap,pt=ve&&!!x.sheenColorMap,Y=ve&&!!x.sheenRoughnessMap,Z=!!x.specularMap,ht=!!x.specularColorMap,R=!!x.specularIntensityMap,J=Ut&&!!x.transmissionMap,q=Ut&&!!x.thicknessMap,ut=!!x.gradientMap,st=!!x.alphaMap,at=x.alphaTest>0,Pt=!!x.alphaHash,$t=!!x.extensions,nt=Gi;x.toneMapped&&(Nt===null||Nt.isXRRenderTarget===!0)&&(nt=s.toneMapping);let Lt=Q?G.isCompressedCubeTexture?G.image[0].mipmaps:G.mipmaps:null,Xt={shaderID:et,shaderType:x.type,shaderName:x.name,vertexShader:Ot,fragmentShader:$,defines:x.defines,customVertexShaderID:xt,customFragmentShaderID:wt,isRawShaderMaterial:x.isRawShaderMaterial===!0,glslVersion:x.glslVersion,precision:W,batching:pe,batchingColor:pe&&D._colorsTexture!==null,instancing:Dt,instancingColor:Dt&&D.instanceColor!==null,instancingMorph:Dt&&D.morphTexture!==null,outputColorSpace:Nt===null?s.outputColorSpace:Nt.isXRRenderTarget===!0?Nt.texture.colorSpace:ne.workingColorSpace,alphaToCoverage:!!x.alphaToCoverage,map:Ft,matcap:Zt,envMap:jt,envMapMode:jt&&G.mapping,envMapPMREM:Q,envMapMaxLod:Q?Lt.length-1:null,envMapSize:Q?Lt[0].width:null,aoMap:ct,lightMap:rt,bumpMap:Mt,normalMap:gt,displacementMap:Ht,emissiveMap:It,normalMapObjectSpace:gt&&x.normalMapType===vp,normalMapTangentSpace:gt&&x.normalMapType===uo,packedNormalMap:gt&&x.normalMapType===uo&&cM(x.normalMap.format),metalnessMap:Kt,roughnessMap:te,anisotropy:oe,anisotropyMap:zt,clearcoat:N,clearcoatMap:w,clearcoatNormalMap:v,clearcoatRoughnessMap:k,diffuseRoughness:Ee,diffuseRoughnessMap:it,dispersion:Jt,retroreflection:he,iridescence:ft,iridescenceMap:j,iridescenceThicknessMap:ot,sheen:ve,sheenColorMap:pt,sheenRoughnessMap:Y,specularMap:Z,specularColorMap:ht,specularIntensityMap:R,transmission:Ut,transmissionMap:J,thicknessMap:q,gradientMap:ut,opaque:x.transparent===!1&&x.blending===ks&&x.alphaToCoverage===!1,alphaMap:st,alphaTest:at,alphaHash:Pt,combine:x.combine,mapUv:Ft&&f(x.map.channel),aoMapUv:ct&&f(x.aoMap.channel),lightMapUv:rt&&f(x.lightMap.channel),bumpMapUv:Mt&&f(x.bumpMap.channel),normalMapUv:gt&&f(x.normalMap.channel),displacementMapUv:Ht&&f(x.displacementMap.channel),emissiveMapUv:It&&f(x.emissiveMap.channel),metalnessMapUv:Kt&&f(x.metalnessMap.channel),roughnessMapUv:te&&f(x.roughnessMap.channel),anisotropyMapUv:zt&&f(x.anisotropyMap.channel),clearcoatMapUv:w&&f(x.clearcoatMap.channel),clearcoatNormalMapUv:v&&f(x.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:k&&f(x.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:it&&f(x.diffuseRoughnessMap.channel),iridescenceMapUv:j&&f(x.iridescenceMap.channel),iridescenceThicknessMapUv:ot&&f(x.iridescenceThicknessMap.channel),sheenColorMapUv:pt&&f(x.sheenColorMap.channel),sheenRoughnessMapUv:Y&&f(x.sheenRoughnessMap.channel),specularMapUv:Z&&f(x.specularMap.channel),specularColorMapUv:ht&&f(x.specularColorMap.channel),specularIntensityMapUv:R&&f(x.specularIntensityMap.channel),transmissionMapUv:J&&f(x.transmissionMap.channel),thicknessMapUv:q&&f(x.thicknessMap.channel),alphaMapUv:st&&f(x.alphaMap.channel),vertexTangents:!!C.attributes.tangent&&(gt||oe),vertexNormals:!!C.attributes.normal,vertexColors:x.vertexColors,vertexAlphas:x.vertexColors===!0&&!!C.attributes.color&&C.attributes.color.itemSize===4,pointsUvs:D.isPoints===!0&&!!C.attributes.uv&&(Ft||st),fog:!!H,useFog:x.fog===!0,fogExp2:!!H&&H.isFogExp2,flatShading:x.wireframe===!1&&(x.flatShading===!0||C.attributes.normal===void 0&&gt===!1&&(x.isMeshLambertMaterial||x.isMeshPhongMaterial||x.isMeshStandardMaterial||x.isMeshPhysicalMaterial)),sizeAttenuation:x.sizeAttenuation===!0,logarithmicDepthBuffer:u,reversedDepthBuffer:_t,skinning:D.isSkinnedMesh===!0,hasPositionAttribute:C.attributes.position!==void 0,morphTargets:C.morphAttributes.position!==void 0,morphNormals:C.morphAttributes.normal!==void 0,morphColors:C.morphAttributes.color!==void 0,morphTargetsCount:tt,morphTextureStride:St,numSunLights:S.sun.length,numDirLights:S.directional.length,numPointLights:S.point.length,numSpotLights:S.spot.length,numSpotLightMaps:S.spotLightMap.length,numRectAreaLights:S.rectArea.length,numHemiLights:S.hemi.length,numSunLightShadows:S.sunShadowMap.length,numDirLightShadows:S.directionalShadowMap.length,numPointLightShadows:S.pointShadowMap.length,numSpotLightShadows:S.spotShadowMap.length,numSpotLightShadowsWithMaps:S.numSpotLightShadowsWithMaps,numLightProbes:S.numLightProbes,numLightProbeGrids:F.filter(vt=>vt.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:x.dithering,shadowMapEnabled:s.shadowMap.enabled&&U.length>0,shadowMapType:s.shadowMap.type,toneMapping:nt,decodeVideoTexture:Ft&&x.map.isVideoTexture===!0&&ne.getTransfer(x.map.colorSpace)===le,decodeVideoTextureEmissive:It&&x.emissiveMap.isVideoTexture===!0&&ne.getTransfer(x.emissiveMap.colorSpace)===le,premultipliedAlpha:x.premultipliedAlpha,doubleSided:x.side===Ie,flipSided:x.side===ze,useDepthPacking:x.depthPacking>=0,depthPacking:x.depthPacking||0,index0AttributeName:x.index0AttributeName,extensionClipCullDistance:$t&&x.extensions.clipCullDistance===!0&&e.has("WEBGL_clip_cull_distance"),extensionMultiDraw:($t&&x.extensions.multiDraw===!0||pe)&&e.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:e.has("KHR_parallel_shader_compile"),customProgramCacheKey:x.customProgramCacheKey()};return Xt.vertexUv1s=l.has(1),Xt.vertexUv2s=l.has(2),Xt.vertexUv3s=l.has(3),l.clear(),Xt}function _(x){let S=[];if(x.shaderID?S.push(x.shaderID):(S.push(x.customVertexShaderID),S.push(x.customFragmentShaderID)),x.defines!==void 0)for(let U in x.defines)S.push(U),S.push(x.defines[U]);return x.isRawShaderMaterial===!1&&(m(S,x),g(S,x),S.push(s.outputColorSpace)),S.push(x.customProgramCacheKey),S.join()}function m(x,S){x.push(S.precision),x.push(S.outputColorSpace),x.push(S.envMapMode),x.push(S.envMapPMREM),x.push(S.envMapMaxLod),x.push(S.envMapSize),x.push(S.mapUv),x.push(S.alphaMapUv),x.push(S.lightMapUv),x.push(S.aoMapUv),x.push(S.bumpMapUv),x.push(S.normalMapUv),x.push(S.displacementMapUv),x.push(S.emissiveMapUv),x.push(S.metalnessMapUv),x.push(S.roughnessMapUv),x.push(S.anisotropyMapUv),x.push(S.clearcoatMapUv),x.push(S.clearcoatNormalMapUv),x.push(S.clearcoatRoughnessMapUv),x.push(S.diffuseRoughnessMapUv),x.push(S.iridescenceMapUv),x.push(S.iridescenceThicknessMapUv),x.push(S.sheenColorMapUv),x.push(S.sheenRoughnessMapUv),x.push(S.specularMapUv),x.push(S.specularColorMapUv),x.push(S.specularIntensityMapUv),x.push(S.transmissionMapUv),x.push(S.thicknessMapUv),x.push(S.combine),x.push(S.fogExp2),x.push(S.sizeAttenuation),x.push(S.morphTargetsCount),x.push(S.numSunLights),x.push(S.numDirLights),x.push(S.numPointLights),x.push(S.numSpotLights),x.push(S.numSpotLightMaps),x.push(S.numHemiLights),x.push(S.numRectAreaLights),x.push(S.numSunLightShadows),x.push(S.numDirLightShadows),x.push(S.numPointLightShadows),x.push(S.numSpotLightShadows),x.push(S.numSpotLightShadowsWithMaps),x.push(S.numLightProbes),x.push(S.numLightProbeGrids),x.push(S.shadowMapType),x.push(S.toneMapping),x.push(S.numClippingPlanes),x.push(S.numClipIntersection),x.push(S.depthPacking)}function g(x,S){o.disableAll(),S.instancing&&o.enable(0),S.instancingColor&&o.enable(1),S.instancingMorph&&o.enable(2),S.matcap&&o.enable(3),S.envMap&&o.enable(4),S.normalMapObjectSpace&&o.enable(5),S.normalMapTangentSpace&&o.enable(6),S.clearcoat&&o.enable(7),S.iridescence&&o.enable(8),S.alphaTest&&o.enable(9),S.vertexColors&&o.enable(10),S.vertexAlphas&&o.enable(11),S.vertexUv1s&&o.enable(12),S.vertexUv2s&&o.enable(13),S.vertexUv3s&&o.enable(14),S.vertexTangents&&o.enable(15),S.anisotropy&&o.enable(16),S.alphaHash&&o.enable(17),S.batching&&o.enable(18),S.dispersion&&o.enable(19),S.retroreflection&&o.enable(24),S.diffuseRoughness&&o.enable(25),S.batchingColor&&o.enable(20),S.gradientMap&&o.enable(21),S.packedNormalMap&&o.enable(22),S.vertexNormals&&o.enable(23),x.push(o.mask),o.disableAll(),S.fog&&o.enable(0),S.useFog&&o.enable(1),S.flatShading&&o.enable(2),S.logarithmicDepthBuffer&&o.enable(3),S.reversedDepthBuffer&&o.enable(4),S.skinning&&o.enable(5),S.morphTargets&&o.enable(6),S.morphNormals&&o.enable(7),S.morphColors&&o.enable(8),S.premultipliedAlpha&&o.enable(9),S.shadowMapEnabled&&o.enable(10),S.doubleSided&&o.enable(11),S.flipSided&&o.enable(12),S.useDepthPacking&&o.enable(13),S.dithering&&o.enable(14),S.transmission&&o.enable(15),S.sheen&&o.enable(16),S.opaque&&o.enable(17),S.pointsUvs&&o.enable(18),S.decodeVideoTexture&&o.enable(19),S.decodeVideoTextureEmissive&&o.enable(20),S.alphaToCoverage&&o.enable(21),S.numLightProbeGrids>0&&o.enable(22),S.hasPositionAttribute&&o.enable(23),x.push(o.mask)}function b(x){let S=d[x.type],U;if(S){let I=Hi[S];U=kp.clone(I.uniforms)}else U=x.uniforms;return U}function E(x,S){let U=h.get(S);return U!==void 0?++U.usedTimes:(U=new aM(s,S,x,n),c.push(U),h.set(S,U)),U}function M(x){if(--x.usedTimes===0){let S=c.indexOf(x);c[S]=c[c.length-1],c.pop(),h.delete(x.cacheKey),x.destroy()}}function T(x){a.remove(x)}function A(){a.dispose()}return{getParameters:p,getProgramCacheKey:_,getUniforms:b,acquireProgram:E,releaseProgram:M,releaseShaderCache:T,programs:c,dispose:A}}function uM(){let s=new WeakMap;function t(o){return s.has(o)}function e(o){let a=s.get(o);return a===void 0&&(a={},s.set(o,a)),a}function i(o){s.delete(o)}function n(o,a,l){s.get(o)[a]=l}function r(){s=new WeakMap}return{has:t,get:e,remove:i,update:n,dispose:r}}function dM(s,t){return s.groupOrder!==t.groupOrder?s.groupOrder-t.groupOrder:s.renderOrder!==t.renderOrder?s.renderOrder-t.renderOrder:s.material.id!==t.material.id?s.material.id-t.material.id:s.materialVariant!==t.materialVariant?s.materialVariant-t.materialVariant:s.z!==t.z?s.z-t.z:s.id-t.id}function sm(s,t){return s.groupOrder!==t.groupOrder?s.groupOrder-t.groupOrder:s.renderOrder!==t.renderOrder?s.renderOrder-t.renderOrder:s.z!==t.z?t.z-s.z:s.id-t.id}function rm(){let s=[],t=0,e=[],i=[],n=[];function r(){t=0,e.length=0,i.length=0,n.length=0}function o(d){let f=0;return d.isInstancedMesh&&(f+=2),d.isSkinnedMesh&&(f+=1),f}function a(d,f,p,_,m,g){let b=s[t];return b===void 0?(b={id:d.id,object:d,geometry:f,material:p,materialVariant:o(d),groupOrder:_,renderOrder:d.renderOrder,z:m,group:g},s[t]=b):(b.id=d.id,b.object=d,b.geometry=f,b.material=p,b.materialVariant=o(d),b.groupOrder=_,b.renderOrder=d.renderOrder,b.z=m,b.group=g),t++,b}function l(d,f,p,_,m,g,b){b.reversedDepth===!0&&(m=-m);let E=a(d,f,p,_,m,g);p.transmission>0?i.push(E):p.transparent===!0?n.push(E):e.push(E)}function c(d,f,p,_,m,g){let b=a(d,f,p,_,m,g);p.transmission>0?i.unshift(b):p.transparent===!0?n.unshift(b):e.unshift(b)}function h(d,f){e.length>1&&e.sort(d||dM),i.length>1&&i.sort(f||sm),n.length>1&&n.sort(f||sm)}function u(){for(let d=t,f=s.length;d<f;d++){let p=s[d];if(p.id===null)break;p.id=null,p.object=null,p.geometry=null,p.material=null,p.group=null}}return{opaque:e,transmissive:i,transparent:n,init:r,push:l,unshift:c,finish:u,sort:h}}function fM(){let s=new WeakMap;function t(i,n){let r=s.get(i),o;return r===void 0?(o=new rm,s.set(i,[o])):n>=r.length?(o=new rm,r.push(o)):o=r[n],o}function e(){s=new WeakMap}return{get:t,dispose:e}}function pM(){let s={};return{get:function(t){if(s[t.id]!==void 0)return s[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={direction:new L,color:new Ct};break;case"SpotLight":e={position:new L,direction:new L,color:new Ct,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":e={position:new L,color:new Ct,distance:0,decay:0};break;case"HemisphereLight":e={direction:new L,skyColor:new Ct,groundColor:new Ct};break;case"RectAreaLight":e={color:new Ct,position:new L,halfWidth:new L,halfHeight:new L};break}return s[t.id]=e,e}}}function mM(){let s={};return{get:function(t){if(s[t.id]!==void 0)return s[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new lt};break;case"SpotLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new lt};break;case"PointLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new lt,shadowCameraNear:1,shadowCameraFar:1e3};break}return s[t.id]=e,e}}}var gM=0;function xM(s,t){return(t.castShadow?2:0)-(s.castShadow?2:0)+(t.map?1:0)-(s.map?1:0)}function _M(s){let t=new pM,e=mM(),i={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)i.probe.push(new L);let n=new L,r=new re,o=new re;function a(c){let h=0,u=0,d=0;for(let F=0;F<9;F++)i.probe[F].set(0,0,0);let f=0,p=0,_=0,m=0,g=0,b=0,E=0,M=0,T=0,A=0,x=0,S=0,U=0,I=0;c.sort(xM);for(let F=0,H=c.length;F<H;F++){let C=c[F],z=C.color,X=C.intensity,G=C.distance,et=null;if(C.shadow&&C.shadow.map&&(C.shadow.map.texture.format===Cn?et=C.shadow.map.texture:et=C.shadow.map.depthTexture||C.shadow.map.texture),C.isAmbientLight)h+=z.r*X,u+=z.g*X,d+=z.b*X;else if(C.isLightProbe){for(let W=0;W<9;W++)i.probe[W].addScaledVector(C.sh.coefficients[W],X);I++}else if(C.isSunLight){let W=t.get(C);if(W.color.copy(C.color).multiplyScalar(C.intensity),C.castShadow){let K=C.shadow,tt=e.get(C);tt.shadowIntensity=K.intensity,tt.shadowBias=K.bias,tt.shadowNormalBias=K.normalBias,tt.shadowRadius=K.radius,tt.shadowMapSize.copy(K.mapSize).multiply(K.getFrameExtents()),i.sunShadow[p]=tt,i.sunShadowMap[p]=et;let St=K.getViewportCount();for(let Ot=0;Ot<St;Ot++)i.sunShadowMatrix[_+Ot]=K.getMatrix(Ot),i.sunShadowCascade[_+Ot]=K._cascadeData[Ot];_+=St,p++}i.sun[f]=W,f++}else if(C.isDirectionalLight){let W=t.get(C);if(W.color.copy(C.color).multiplyScalar(C.intensity),C.castShadow){let K=C.shadow,tt=e.get(C);tt.shadowIntensity=K.intensity,tt.shadowBias=K.bias,tt.shadowNormalBias=K.normalBias,tt.shadowRadius=K.radius,tt.shadowMapSize=K.mapSize,i.directionalShadow[m]=tt,i.directionalShadowMap[m]=et,i.directionalShadowMatrix[m]=C.shadow.matrix,T++}i.directional[m]=W,m++}else if(C.isSpotLight){let W=t.get(C);W.position.setFromMatrixPosition(C.matrixWorld),W.color.copy(z).multiplyScalar(X),W.distance=G,W.coneCos=Math.cos(C.angle),W.penumbraCos=Math.cos(C.angle*(1-C.penumbra)),W.decay=C.decay,i.spot[b]=W;let K=C.shadow;if(C.map&&(i.spotLightMap[S]=C.map,S++,K.updateMatrices(C),C.castShadow&&U++),i.spotLightMatrix[b]=K.matrix,C.castShadow){let tt=e.get(C);tt.shadowIntensity=K.intensity,tt.shadowBias=K.bias,tt.shadowNormalBias=K.normalBias,tt.shadowRadius=K.radius,tt.shadowMapSize=K.mapSize,i.spotShadow[b]=tt,i.spotShadowMap[b]=et,x++}b++}else if(C.isRectAreaLight){let W=t.get(C);W.color.copy(z).multiplyScalar(X),W.halfWidth.set(C.width*.5,0,0),W.halfHeight.set(0,C.height*.5,0),i.rectArea[E]=W,E++}else if(C.isPointLight){let W=t.get(C);if(W.color.copy(C.color).multiplyScalar(C.intensity),W.distance=C.distance,W.decay=C.decay,C.castShadow){let K=C.shadow,tt=e.get(C);tt.shadowIntensity=K.intensity,tt.shadowBias=K.bias,tt.shadowNormalBias=K.normalBias,tt.shadowRadius=K.radius,tt.shadowMapSize=K.mapSize,tt.shadowCameraNear=K.camera.near,tt.shadowCameraFar=K.camera.far,i.pointShadow[g]=tt,i.pointShadowMap[g]=et,i.pointShadowMatrix[g]=C.shadow.matrix,A++}i.point[g]=W,g++}else if(C.isHemisphereLight){let W=t.get(C);W.skyColor.copy(C.color).multiplyScalar(X),W.groundColor.copy(C.groundColor).multiplyScalar(X),i.hemi[M]=W,M++}}E>0&&(s.has("OES_texture_float_linear")===!0?(i.rectAreaLTC1=yt.LTC_FLOAT_1,i.rectAreaLTC2=yt.LTC_FLOAT_2):(i.rectAreaLTC1=yt.LTC_HALF_1,i.rectAreaLTC2=yt.LTC_HALF_2)),i.ambient[0]=h,i.ambient[1]=u,i.ambient[2]=d;let D=i.hash;(D.sunLength!==f||D.directionalLength!==m||D.pointLength!==g||D.spotLength!==b||D.rectAreaLength!==E||D.hemiLength!==M||D.numSunShadows!==p||D.numDirectionalShadows!==T||D.numPointShadows!==A||D.numSpotShadows!==x||D.numSpotMaps!==S||D.numLightProbes!==I)&&(i.sun.length=f,i.directional.length=m,i.spot.length=b,i.rectArea.length=E,i.point.length=g,i.hemi.length=M,i.sunShadow.length=p,i.sunShadowMap.length=p,i.sunShadowMatrix.length=_,i.sunShadowCascade.length=_,i.directionalShadow.length=T,i.directionalShadowMap.length=T,i.directionalShadowMatrix.length=T,i.pointShadow.length=A,i.pointShadowMap.length=A,i.pointShadowMatrix.length=A,i.spotShadow.length=x,i.spotShadowMap.length=x,i.spotLightMatrix.length=x+S-U,i.spotLightMap.length=S,i.numSpotLightShadowsWithMaps=U,i.numLightProbes=I,D.sunLength=f,D.directionalLength=m,D.pointLength=g,D.spotLength=b,D.rectAreaLength=E,D.hemiLength=M,D.numSunShadows=p,D.numDirectionalShadows=T,D.numPointShadows=A,D.numSpotShadows=x,D.numSpotMaps=S,D.numLightProbes=I,i.version=gM++)}function l(c,h){let u=0,d=0,f=0,p=0,_=0,m=0,g=h.matrixWorldInverse;for(let b=0,E=c.length;b<E;b++){let M=c[b];if(M.isSunLight){let T=i.sun[u];T.direction.setFromMatrixPosition(M.matrixWorld),T.direction.transformDirection(g),u++}else if(M.isDirectionalLight){let T=i.directional[d];T.direction.setFromMatrixPosition(M.matrixWorld),n.setFromMatrixPosition(M.target.matrixWorld),T.direction.sub(n),T.direction.transformDirection(g),d++}else if(M.isSpotLight){let T=i.spot[p];T.position.setFromMatrixPosition(M.matrixWorld),T.position.applyMatrix4(g),T.direction.setFromMatrixPosition(M.matrixWorld),n.setFromMatrixPosition(M.target.matrixWorld),T.direction.sub(n),T.direction.transformDirection(g),p++}else if(M.isRectAreaLight){let T=i.rectArea[_];T.position.setFromMatrixPosition(M.matrixWorld),T.position.applyMatrix4(g),o.identity(),r.copy(M.matrixWorld),r.premultiply(g),o.extractRotation(r),T.halfWidth.set(M.width*.5,0,0),T.halfHeight.set(0,M.height*.5,0),T.halfWidth.applyMatrix4(o),T.halfHeight.applyMatrix4(o),_++}else if(M.isPointLight){let T=i.point[f];T.position.setFromMatrixPosition(M.matrixWorld),T.position.applyMatrix4(g),f++}else if(M.isHemisphereLight){let T=i.hemi[m];T.direction.setFromMatrixPosition(M.matrixWorld),T.direction.transformDirection(g),m++}}}return{setup:a,setupView:l,state:i}}function om(s){let t=new _M(s),e=[],i=[],n=[];function r(u){h.camera=u,e.length=0,i.length=0,n.length=0}function o(u){u.isLightProbeGrid?n.push(u):e.push(u)}function a(u){i.push(u)}function l(){t.setup(e),n.sort((u,d)=>u.priority-d.priority||u.id-d.id)}function c(u){t.setupView(e,u)}let h={lightsArray:e,shadowsArray:i,lightProbeGridArray:n,camera:null,lights:t,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:h,setupLights:l,setupLightsView:c,pushLight:o,pushShadow:a}}function vM(s){let t=new WeakMap;function e(n,r=0){let o=t.get(n),a;return o===void 0?(a=new om(s),t.set(n,[a])):r>=o.length?(a=new om(s),o.push(a)):a=o[r],a}function i(){t=new WeakMap}return{get:e,dispose:i}}var yM=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,bM=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ).rg;
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ).r;
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( max( 0.0, squared_mean - mean * mean ) );
	gl_FragColor = vec4( mean, std_dev, 0.0, 1.0 );
}`,MM=[new L(1,0,0),new L(-1,0,0),new L(0,1,0),new L(0,-1,0),new L(0,0,1),new L(0,0,-1)],SM=[new L(0,-1,0),new L(0,-1,0),new L(0,0,1),new L(0,0,-1),new L(0,-1,0),new L(0,-1,0)],am=new re,fo=new L,Iu=new L;function wM(s,t,e){let i=new bn,n=new lt,r=new lt,o=new fe,a=new el,l=new il,c={},h=e.maxTextureSize,u={[Rn]:ze,[ze]:Rn,[Ie]:Ie},d=new Me({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new lt},radius:{value:4}},vertexShader:yM,fragmentShader:bM}),f=d.clone();f.defines.HORIZONTAL_PASS=1;let p=new _e;p.setAttribute("position",new ti(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let _=new Wt(p,d),m=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=Jn;let g=this.type;this.render=function(A,x,S){if(m.enabled===!1||m.autoUpdate===!1&&m.needsUpdate===!1||A.length===0)return;this.type===Jf&&(kt("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=Jn);let U=s.getRenderTarget(),I=s.getActiveCubeFace(),D=s.getActiveMipmapLevel(),F=s.state;F.setBlending(jn),F.buffers.depth.getReversed()===!0?F.buffers.color.setClear(0,0,0,0):F.buffers.color.setClear(1,1,1,1),F.buffers.depth.setTest(!0),F.setScissorTest(!1);let H=g!==this.type;H&&x.traverse(function(C){C.material&&(Array.isArray(C.material)?C.material.forEach(z=>z.needsUpdate=!0):C.material.needsUpdate=!0)});for(let C=0,z=A.length;C<z;C++){let X=A[C],G=X.shadow;if(G===void 0){kt("WebGLShadowMap:",X,"has no shadow.");continue}if(G.autoUpdate===!1&&G.needsUpdate===!1)continue;n.copy(G.mapSize);let et=G.getFrameExtents();n.multiply(et),r.copy(G.mapSize),(n.x>h||n.y>h)&&(n.x>h&&(r.x=Math.floor(h/et.x),n.x=r.x*et.x,G.mapSize.x=r.x),n.y>h&&(r.y=Math.floor(h/et.y),n.y=r.y*et.y,G.mapSize.y=r.y));let W=s.state.buffers.depth.getReversed();if(G.camera._reversedDepth=W,G.map===null||H===!0){if(G.map!==null&&(G.map.depthTexture!==null&&(G.map.depthTexture.dispose(),G.map.depthTexture=null),G.map.dispose()),this.type===Fs){if(X.isPointLight){kt("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}G.map=new li(n.x,n.y,{format:Cn,type:Ri,minFilter:Je,magFilter:Je,generateMipmaps:!1}),G.map.texture.name=X.name+".shadowMap",G.map.depthTexture=new nn(n.x,n.y,xi),G.map.depthTexture.name=X.name+".shadowMapDepth",G.map.depthTexture.format=en,G.map.depthTexture.compareFunction=null,G.map.depthTexture.minFilter=Fe,G.map.depthTexture.magFilter=Fe}else X.isPointLight?(G.map=new mo(n.x),G.map.depthTexture=new Dr(n.x,Ti)):(G.map=new li(n.x,n.y),G.map.depthTexture=new nn(n.x,n.y,Ti)),G.map.depthTexture.name=X.name+".shadowMap",G.map.depthTexture.format=en,this.type===Jn?(G.map.depthTexture.compareFunction=W?mu:pu,G.map.depthTexture.minFilter=Je,G.map.depthTexture.magFilter=Je):(G.map.depthTexture.compareFunction=null,G.map.depthTexture.minFilter=Fe,G.map.depthTexture.magFilter=Fe);G.camera.updateProjectionMatrix()}G.map.isWebGLCubeRenderTarget!==!0&&(G.map.width!==n.x||G.map.height!==n.y)&&G.map.setSize(n.x,n.y);let K=G.map.isWebGLCubeRenderTarget?6:G.getViewportCount();X.isPointLight!==!0&&G.updateMatrices(X,S);let tt=(G.camera.layers.mask&4294967294)!==0?G.camera.layers:S.layers;for(let St=0;St<K;St++){let Ot=G.getCamera(St);if(X.isPointLight){let $=G.camera,xt=G.matrix,wt=X.distance||$.far;wt!==$.far&&($.far=wt,$.updateProjectionMatrix()),fo.setFromMatrixPosition(X.matrixWorld),$.position.copy(fo),Iu.copy($.position),Iu.add(MM[St]),$.up.copy(SM[St]),$.lookAt(Iu),$.updateMatrixWorld(),xt.makeTranslation(-fo.x,-fo.y,-fo.z),am.multiplyMatrices($.projectionMatrix,$.matrixWorldInverse),G._frustum.setFromProjectionMatrix(am,$.coordinateSystem,$.reversedDepth)}if(G.map.isWebGLCubeRenderTarget)s.setRenderTarget(G.map,St),s.clear();else{St===0&&(s.setRenderTarget(G.map),s.clear());let $=G.getViewport(St);o.set(r.x*$.x,r.y*$.y,r.x*$.z,r.y*$.w),F.viewport(o)}i=G.getFrustum(St),M(x,S,Ot,X,tt,this.type)}G.isPointLightShadow!==!0&&this.type===Fs&&b(G,S),G.needsUpdate=!1}g=this.type,m.needsUpdate=!1,s.setRenderTarget(U,I,D)};function b(A,x){let S=t.update(_);d.defines.VSM_SAMPLES!==A.blurSamples&&(d.defines.VSM_SAMPLES=A.blurSamples,f.defines.VSM_SAMPLES=A.blurSamples,d.needsUpdate=!0,f.needsUpdate=!0),A.mapPass===null?A.mapPass=new li(n.x,n.y,{format:Cn,type:Ri}):(A.mapPass.width!==A.map.width||A.mapPass.height!==A.map.height)&&A.mapPass.setSize(A.map.width,A.map.height),d.uniforms.shadow_pass.value=A.map.depthTexture,d.uniforms.resolution.value.set(A.map.width,A.map.height),d.uniforms.radius.value=A.radius,s.setRenderTarget(A.mapPass),s.clear(),s.renderBufferDirect(x,null,S,d,_,null),f.uniforms.shadow_pass.value=A.mapPass.texture,f.uniforms.resolution.value.set(A.map.width,A.map.height),f.uniforms.radius.value=A.radius,s.setRenderTarget(A.map),s.clear(),s.renderBufferDirect(x,null,S,f,_,null)}function E(A,x,S,U){let I=null,D=S.isPointLight===!0?A.customDistanceMaterial:A.customDepthMaterial;if(D!==void 0)I=D;else if(I=S.isPointLight===!0?l:a,s.localClippingEnabled&&x.clipShadows===!0&&Array.isArray(x.clippingPlanes)&&x.clippingPlanes.length!==0||x.displacementMap&&x.displacementScale!==0||x.alphaMap&&x.alphaTest>0||x.map&&x.alphaTest>0||x.alphaToCoverage===!0){let F=I.uuid,H=x.uuid,C=c[F];C===void 0&&(C={},c[F]=C);let z=C[H];z===void 0&&(z=I.clone(),C[H]=z,x.addEventListener("dispose",T)),I=z}if(I.visible=x.visible,I.wireframe=x.wireframe,U===Fs?I.side=x.shadowSide!==null?x.shadowSide:x.side:I.side=x.shadowSide!==null?x.shadowSide:u[x.side],I.alphaMap=x.alphaMap,I.alphaTest=x.alphaToCoverage===!0?.5:x.alphaTest,I.map=x.map,I.clipShadows=x.clipShadows,I.clippingPlanes=x.clippingPlanes,I.clipIntersection=x.clipIntersection,I.displacementMap=x.displacementMap,I.displacementScale=x.displacementScale,I.displacementBias=x.displacementBias,I.wireframeLinewidth=x.wireframeLinewidth,I.linewidth=x.linewidth,S.isPointLight===!0&&I.isMeshDistanceMaterial===!0){let F=s.properties.get(I);F.light=S}return I}function M(A,x,S,U,I,D){if(A.visible===!1)return;if(A.layers.test(I)&&(A.isMesh||A.isLine||A.isPoints)&&(A.castShadow||A.receiveShadow&&D===Fs)&&(!A.frustumCulled||A.intersectsFrustum(i))){A.modelViewMatrix.multiplyMatrices(S.matrixWorldInverse,A.matrixWorld);let C=t.update(A),z=A.material;if(Array.isArray(z)){let X=C.groups;for(let G=0,et=X.length;G<et;G++){let W=X[G],K=z[W.materialIndex];if(K&&K.visible){let tt=E(A,K,U,D);A.onBeforeShadow(s,A,x,S,C,tt,W),s.renderBufferDirect(S,null,C,tt,A,W),A.onAfterShadow(s,A,x,S,C,tt,W)}}}else if(z.visible){let X=E(A,z,U,D);A.onBeforeShadow(s,A,x,S,C,X,null),s.renderBufferDirect(S,null,C,X,A,null),A.onAfterShadow(s,A,x,S,C,X,null)}}let H=A.children;for(let C=0,z=H.length;C<z;C++)M(H[C],x,S,U,I,D)}function T(A){A.target.removeEventListener("dispose",T);for(let S in c){let U=c[S],I=A.target.uuid;I in U&&(U[I].dispose(),delete U[I])}}}function EM(s,t){function e(){let R=!1,J=new fe,q=null,ut=new fe(0,0,0,0);return{setMask:function(st){q!==st&&!R&&(s.colorMask(st,st,st,st),q=st)},setLocked:function(st){R=st},setClear:function(st,at,Pt,$t,nt){nt===!0&&(st*=$t,at*=$t,Pt*=$t),J.set(st,at,Pt,$t),ut.equals(J)===!1&&(s.clearColor(st,at,Pt,$t),ut.copy(J))},reset:function(){R=!1,q=null,ut.set(-1,0,0,0)}}}function i(){let R=!1,J=!1,q=null,ut=null,st=null;return{setReversed:function(at){if(J!==at){let Pt=t.get("EXT_clip_control");at?Pt.clipControlEXT(Pt.LOWER_LEFT_EXT,Pt.ZERO_TO_ONE_EXT):Pt.clipControlEXT(Pt.LOWER_LEFT_EXT,Pt.NEGATIVE_ONE_TO_ONE_EXT),J=at;let $t=st;st=null,this.setClear($t)}},getReversed:function(){return J},setTest:function(at){at?_t(s.DEPTH_TEST):Dt(s.DEPTH_TEST)},setMask:function(at){q!==at&&!R&&(s.depthMask(at),q=at)},setFunc:function(at){if(J&&(at=Cp[at]),ut!==at){switch(at){case Ca:s.depthFunc(s.NEVER);break;case Ia:s.depthFunc(s.ALWAYS);break;case Pa:s.depthFunc(s.LESS);break;case Ms:s.depthFunc(s.LEQUAL);break;case La:s.depthFunc(s.EQUAL);break;case Na:s.depthFunc(s.GEQUAL);break;case Da:s.depthFunc(s.GREATER);break;case Ua:s.depthFunc(s.NOTEQUAL);break;default:s.depthFunc(s.LEQUAL)}ut=at}},setLocked:function(at){R=at},setClear:function(at){st!==at&&(st=at,J&&(at=1-at),s.clearDepth(at))},reset:function(){R=!1,q=null,ut=null,st=null,J=!1}}}function n(){let R=!1,J=null,q=null,ut=null,st=null,at=null,Pt=null,$t=null,nt=null;return{setTest:function(Lt){R||(Lt?_t(s.STENCIL_TEST):Dt(s.STENCIL_TEST))},setMask:function(Lt){J!==Lt&&!R&&(s.stencilMask(Lt),J=Lt)},setFunc:function(Lt,Xt,vt){(q!==Lt||ut!==Xt||st!==vt)&&(s.stencilFunc(Lt,Xt,vt),q=Lt,ut=Xt,st=vt)},setOp:function(Lt,Xt,vt){(at!==Lt||Pt!==Xt||$t!==vt)&&(s.stencilOp(Lt,Xt,vt),at=Lt,Pt=Xt,$t=vt)},setLocked:function(Lt){R=Lt},setClear:function(Lt){nt!==Lt&&(s.clearStencil(Lt),nt=Lt)},reset:function(){R=!1,J=null,q=null,ut=null,st=null,at=null,Pt=null,$t=null,nt=null}}}let r=new e,o=new i,a=new n,l={},c=new WeakMap,h={},u={},d={},f=new WeakMap,p=[],_=null,m=!1,g=null,b=null,E=null,M=null,T=null,A=null,x=null,S=new Ct(0,0,0),U=0,I=!1,D=null,F=null,H=null,C=null,z=null,X=s.getParameter(s.MAX_COMBINED_TEXTURE_IMAGE_UNITS),G=!1,et=0,W=s.getParameter(s.VERSION);W.indexOf("WebGL")!==-1?(et=parseFloat(/^WebGL (\d)/.exec(W)[1]),G=et>=1):W.indexOf("OpenGL ES")!==-1&&(et=parseFloat(/^OpenGL ES (\d)/.exec(W)[1]),G=et>=2);let K=null,tt={},St=s.getParameter(s.SCISSOR_BOX),Ot=s.getParameter(s.VIEWPORT),$=new fe().fromArray(St),xt=new fe().fromArray(Ot);function wt(R,J,q,ut){let st=new Uint8Array(4),at=s.createTexture();s.bindTexture(R,at),s.texParameteri(R,s.TEXTURE_MIN_FILTER,s.NEAREST),s.texParameteri(R,s.TEXTURE_MAG_FILTER,s.NEAREST);for(let Pt=0;Pt<q;Pt++)R===s.TEXTURE_3D||R===s.TEXTURE_2D_ARRAY?s.texImage3D(J,0,s.RGBA,1,1,ut,0,s.RGBA,s.UNSIGNED_BYTE,st):s.texImage2D(J+Pt,0,s.RGBA,1,1,0,s.RGBA,s.UNSIGNED_BYTE,st);return at}let Nt={};Nt[s.TEXTURE_2D]=wt(s.TEXTURE_2D,s.TEXTURE_2D,1),Nt[s.TEXTURE_CUBE_MAP]=wt(s.TEXTURE_CUBE_MAP,s.TEXTURE_CUBE_MAP_POSITIVE_X,6),Nt[s.TEXTURE_2D_ARRAY]=wt(s.TEXTURE_2D_ARRAY,s.TEXTURE_2D_ARRAY,1,1),Nt[s.TEXTURE_3D]=wt(s.TEXTURE_3D,s.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),_t(s.DEPTH_TEST),o.setFunc(Ms),Mt(!1),gt(Yh),_t(s.CULL_FACE),ct(jn);function _t(R){h[R]!==!0&&(s.enable(R),h[R]=!0)}function Dt(R){h[R]!==!1&&(s.disable(R),h[R]=!1)}function pe(R,J){return d[R]!==J?(s.bindFramebuffer(R,J),d[R]=J,R===s.DRAW_FRAMEBUFFER&&(d[s.FRAMEBUFFER]=J),R===s.FRAMEBUFFER&&(d[s.DRAW_FRAMEBUFFER]=J),!0):!1}function Ft(R,J){let q=p,ut=!1;if(R){q=f.get(J),q===void 0&&(q=[],f.set(J,q));let st=R.textures;if(q.length!==st.length||q[0]!==s.COLOR_ATTACHMENT0){for(let at=0,Pt=st.length;at<Pt;at++)q[at]=s.COLOR_ATTACHMENT0+at;q.length=st.length,ut=!0}}else q[0]!==s.BACK&&(q[0]=s.BACK,ut=!0);ut&&s.drawBuffers(q)}function Zt(R){return _!==R?(s.useProgram(R),_=R,!0):!1}let jt={[Kn]:s.FUNC_ADD,[Kf]:s.FUNC_SUBTRACT,[Qf]:s.FUNC_REVERSE_SUBTRACT};jt[tp]=s.MIN,jt[ep]=s.MAX;let Q={[ip]:s.ZERO,[np]:s.ONE,[sp]:s.SRC_COLOR,[Kh]:s.SRC_ALPHA,[hp]:s.SRC_ALPHA_SATURATE,[lp]:s.DST_COLOR,[op]:s.DST_ALPHA,[rp]:s.ONE_MINUS_SRC_COLOR,[Qh]:s.ONE_MINUS_SRC_ALPHA,[cp]:s.ONE_MINUS_DST_COLOR,[ap]:s.ONE_MINUS_DST_ALPHA,[up]:s.CONSTANT_COLOR,[dp]:s.ONE_MINUS_CONSTANT_COLOR,[fp]:s.CONSTANT_ALPHA,[pp]:s.ONE_MINUS_CONSTANT_ALPHA};function ct(R,J,q,ut,st,at,Pt,$t,nt,Lt){if(R===jn){m===!0&&(Dt(s.BLEND),m=!1);return}if(m===!1&&(_t(s.BLEND),m=!0),R!==jf){if(R!==g||Lt!==I){if((b!==Kn||T!==Kn)&&(s.blendEquation(s.FUNC_ADD),b=Kn,T=Kn),Lt)switch(R){case ks:s.blendFuncSeparate(s.ONE,s.ONE_MINUS_SRC_ALPHA,s.ONE,s.ONE_MINUS_SRC_ALPHA);break;case Zh:s.blendFunc(s.ONE,s.ONE);break;case Jh:s.blendFuncSeparate(s.ZERO,s.ONE_MINUS_SRC_COLOR,s.ZERO,s.ONE);break;case jh:s.blendFuncSeparate(s.DST_COLOR,s.ONE_MINUS_SRC_ALPHA,s.ZERO,s.ONE);break;default:Bt("WebGLState: Invalid blending: ",R);break}else switch(R){case ks:s.blendFuncSeparate(s.SRC_ALPHA,s.ONE_MINUS_SRC_ALPHA,s.ONE,s.ONE_MINUS_SRC_ALPHA);break;case Zh:s.blendFuncSeparate(s.SRC_ALPHA,s.ONE,s.ONE,s.ONE);break;case Jh:Bt("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case jh:Bt("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:Bt("WebGLState: Invalid blending: ",R);break}E=null,M=null,A=null,x=null,S.set(0,0,0),U=0,g=R,I=Lt}return}st=st||J,at=at||q,Pt=Pt||ut,(J!==b||st!==T)&&(s.blendEquationSeparate(jt[J],jt[st]),b=J,T=st),(q!==E||ut!==M||at!==A||Pt!==x)&&(s.blendFuncSeparate(Q[q],Q[ut],Q[at],Q[Pt]),E=q,M=ut,A=at,x=Pt),($t.equals(S)===!1||nt!==U)&&(s.blendColor($t.r,$t.g,$t.b,nt),S.copy($t),U=nt),g=R,I=!1}function rt(R,J){R.side===Ie?Dt(s.CULL_FACE):_t(s.CULL_FACE);let q=R.side===ze;J&&(q=!q),Mt(q),R.blending===ks&&R.transparent===!1?ct(jn):ct(R.blending,R.blendEquation,R.blendSrc,R.blendDst,R.blendEquationAlpha,R.blendSrcAlpha,R.blendDstAlpha,R.blendColor,R.blendAlpha,R.premultipliedAlpha),o.setFunc(R.depthFunc),o.setTest(R.depthTest),o.setMask(R.depthWrite),r.setMask(R.colorWrite);let ut=R.stencilWrite;a.setTest(ut),ut&&(a.setMask(R.stencilWriteMask),a.setFunc(R.stencilFunc,R.stencilRef,R.stencilFuncMask),a.setOp(R.stencilFail,R.stencilZFail,R.stencilZPass)),It(R.polygonOffset,R.polygonOffsetFactor,R.polygonOffsetUnits),R.alphaToCoverage===!0?_t(s.SAMPLE_ALPHA_TO_COVERAGE):Dt(s.SAMPLE_ALPHA_TO_COVERAGE)}function Mt(R){D!==R&&(R?s.frontFace(s.CW):s.frontFace(s.CCW),D=R)}function gt(R){R!==Yf?(_t(s.CULL_FACE),R!==F&&(R===Yh?s.cullFace(s.BACK):R===Zf?s.cullFace(s.FRONT):s.cullFace(s.FRONT_AND_BACK))):Dt(s.CULL_FACE),F=R}function Ht(R){R!==H&&(G&&s.lineWidth(R),H=R)}function It(R,J,q){R?(_t(s.POLYGON_OFFSET_FILL),(C!==J||z!==q)&&(C=J,z=q,o.getReversed()&&(J=-J,q=-q),s.polygonOffset(J,q))):Dt(s.POLYGON_OFFSET_FILL)}function Kt(R){R?_t(s.SCISSOR_TEST):Dt(s.SCISSOR_TEST)}function te(R){R===void 0&&(R=s.TEXTURE0+X-1),K!==R&&(s.activeTexture(R),K=R)}function oe(R,J,q){q===void 0&&(K===null?q=s.TEXTURE0+X-1:q=K);let ut=tt[q];ut===void 0&&(ut={type:void 0,texture:void 0},tt[q]=ut),(ut.type!==R||ut.texture!==J)&&(K!==q&&(s.activeTexture(q),K=q),s.bindTexture(R,J||Nt[R]),ut.type=R,ut.texture=J)}function N(){let R=tt[K];R!==void 0&&R.type!==void 0&&(s.bindTexture(R.type,null),R.type=void 0,R.texture=void 0)}function Ee(){try{s.compressedTexImage2D(...arguments)}catch(R){Bt("WebGLState:",R)}}function Jt(){try{s.compressedTexImage3D(...arguments)}catch(R){Bt("WebGLState:",R)}}function he(){try{s.texSubImage2D(...arguments)}catch(R){Bt("WebGLState:",R)}}function ft(){try{s.texSubImage3D(...arguments)}catch(R){Bt("WebGLState:",R)}}function ve(){try{s.compressedTexSubImage2D(...arguments)}catch(R){Bt("WebGLState:",R)}}function Ut(){try{s.compressedTexSubImage3D(...arguments)}catch(R){Bt("WebGLState:",R)}}function zt(){try{s.texStorage2D(...arguments)}catch(R){Bt("WebGLState:",R)}}function w(){try{s.texStorage3D(...arguments)}catch(R){Bt("WebGLState:",R)}}function v(){try{s.texImage2D(...arguments)}catch(R){Bt("WebGLState:",R)}}function k(){try{s.texImage3D(...arguments)}catch(R){Bt("WebGLState:",R)}}function it(R){return u[R]!==void 0?u[R]:s.getParameter(R)}function j(R,J){u[R]!==J&&(s.pixelStorei(R,J),u[R]=J)}function ot(R){$.equals(R)===!1&&(s.scissor(R.x,R.y,R.z,R.w),$.copy(R))}function pt(R){xt.equals(R)===!1&&(s.viewport(R.x,R.y,R.z,R.w),xt.copy(R))}function Y(R,J){let q=c.get(J);q===void 0&&(q=new WeakMap,c.set(J,q));let ut=q.get(R);ut===void 0&&(ut=s.getUniformBlockIndex(J,R.name),s.uniformBlockBinding(J,ut,ut),q.set(R,ut))}function Z(R,J,q){let st=c.get(J).get(R);l[st]!==q&&(s.bindBufferBase(s.UNIFORM_BUFFER,st,q),l[st]=q)}function ht(){s.disable(s.BLEND),s.disable(s.CULL_FACE),s.disable(s.DEPTH_TEST),s.disable(s.POLYGON_OFFSET_FILL),s.disable(s.SCISSOR_TEST),s.disable(s.STENCIL_TEST),s.disable(s.SAMPLE_ALPHA_TO_COVERAGE),s.blendEquation(s.FUNC_ADD),s.blendFunc(s.ONE,s.ZERO),s.blendFuncSeparate(s.ONE,s.ZERO,s.ONE,s.ZERO),s.blendColor(0,0,0,0),s.colorMask(!0,!0,!0,!0),s.clearColor(0,0,0,0),s.depthMask(!0),s.depthFunc(s.LESS),o.setReversed(!1),s.clearDepth(1),s.stencilMask(4294967295),s.stencilFunc(s.ALWAYS,0,4294967295),s.stencilOp(s.KEEP,s.KEEP,s.KEEP),s.clearStencil(0),s.cullFace(s.BACK),s.frontFace(s.CCW),s.polygonOffset(0,0),s.activeTexture(s.TEXTURE0),s.bindFramebuffer(s.FRAMEBUFFER,null),s.bindFramebuffer(s.DRAW_FRAMEBUFFER,null),s.bindFramebuffer(s.READ_FRAMEBUFFER,null),s.useProgram(null),s.lineWidth(1),s.scissor(0,0,s.canvas.width,s.canvas.height),s.viewport(0,0,s.canvas.width,s.canvas.height),s.pixelStorei(s.PACK_ALIGNMENT,4),s.pixelStorei(s.UNPACK_ALIGNMENT,4),s.pixelStorei(s.UNPACK_FLIP_Y_WEBGL,!1),s.pixelStorei(s.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),s.pixelStorei(s.UNPACK_COLORSPACE_CONVERSION_WEBGL,s.BROWSER_DEFAULT_WEBGL),s.pixelStorei(s.PACK_ROW_LENGTH,0),s.pixelStorei(s.PACK_SKIP_PIXELS,0),s.pixelStorei(s.PACK_SKIP_ROWS,0),s.pixelStorei(s.UNPACK_ROW_LENGTH,0),s.pixelStorei(s.UNPACK_IMAGE_HEIGHT,0),s.pixelStorei(s.UNPACK_SKIP_PIXELS,0),s.pixelStorei(s.UNPACK_SKIP_ROWS,0),s.pixelStorei(s.UNPACK_SKIP_IMAGES,0),h={},u={},K=null,tt={},d={},l={},f=new WeakMap,p=[],_=null,m=!1,g=null,b=null,E=null,M=null,T=null,A=null,x=null,S=new Ct(0,0,0),U=0,I=!1,D=null,F=null,H=null,C=null,z=null,$.set(0,0,s.canvas.width,s.canvas.height),xt.set(0,0,s.canvas.width,s.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:_t,disable:Dt,bindFramebuffer:pe,drawBuffers:Ft,useProgram:Zt,setBlending:ct,setMaterial:rt,setFlipSided:Mt,setCullFace:gt,setLineWidth:Ht,setPolygonOffset:It,setScissorTest:Kt,activeTexture:te,bindTexture:oe,unbindTexture:N,compressedTexImage2D:Ee,compressedTexImage3D:Jt,texImage2D:v,texImage3D:k,pixelStorei:j,getParameter:it,updateUBOMapping:Y,uniformBlockBinding:Z,texStorage2D:zt,texStorage3D:w,texSubImage2D:he,texSubImage3D:ft,compressedTexSubImage2D:ve,compressedTexSubImage3D:Ut,scissor:ot,viewport:pt,reset:ht}}function AM(s,t,e,i,n,r,o){let a=t.has("WEBGL_multisampled_render_to_texture")?t.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new lt,h=new WeakMap,u=new Set,d,f=new WeakMap,p=new Set,_=new FinalizationRegistry(w=>p.delete(w)),m=!1;try{m=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function g(w,v){return m?new OffscreenCanvas(w,v):Sr("canvas")}function b(w,v,k){let it=1,j=zt(w);if((j.width>k||j.height>k)&&(it=k/Math.max(j.width,j.height)),it<1)if(typeof HTMLImageElement<"u"&&w instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&w instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&w instanceof ImageBitmap||typeof VideoFrame<"u"&&w instanceof VideoFrame){let ot=Math.floor(it*j.width),pt=Math.floor(it*j.height);d===void 0&&(d=g(ot,pt));let Y=v?g(ot,pt):d;return Y.width=ot,Y.height=pt,Y.getContext("2d").drawImage(w,0,0,ot,pt),kt("WebGLRenderer: Texture has been resized from ("+j.width+"x"+j.height+") to ("+ot+"x"+pt+")."),Y}else return"data"in w&&kt("WebGLRenderer: Image in DataTexture is too big ("+j.width+"x"+j.height+")."),w;return w}function E(w){return w.generateMipmaps}function M(w){s.generateMipmap(w)}function T(w){return w.isWebGLCubeRenderTarget?s.TEXTURE_CUBE_MAP:w.isWebGL3DRenderTarget?s.TEXTURE_3D:w.isWebGLArrayRenderTarget||w.isCompressedArrayTexture?s.TEXTURE_2D_ARRAY:s.TEXTURE_2D}function A(w,v,k,it,j,ot=!1){if(w!==null){if(s[w]!==void 0)return s[w];kt("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+w+"'")}let pt;it&&(pt=t.get("EXT_texture_norm16"),pt||kt("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let Y=v;if(v===s.RED&&(k===s.FLOAT&&(Y=s.R32F),k===s.HALF_FLOAT&&(Y=s.R16F),k===s.UNSIGNED_BYTE&&(Y=s.R8),k===s.UNSIGNED_SHORT&&pt&&(Y=pt.R16_EXT),k===s.SHORT&&pt&&(Y=pt.R16_SNORM_EXT)),v===s.RED_INTEGER&&(k===s.UNSIGNED_BYTE&&(Y=s.R8UI),k===s.UNSIGNED_SHORT&&(Y=s.R16UI),k===s.UNSIGNED_INT&&(Y=s.R32UI),k===s.BYTE&&(Y=s.R8I),k===s.SHORT&&(Y=s.R16I),k===s.INT&&(Y=s.R32I)),v===s.RG&&(k===s.FLOAT&&(Y=s.RG32F),k===s.HALF_FLOAT&&(Y=s.RG16F),k===s.UNSIGNED_BYTE&&(Y=s.RG8),k===s.UNSIGNED_SHORT&&pt&&(Y=pt.RG16_EXT),k===s.SHORT&&pt&&(Y=pt.RG16_SNORM_EXT)),v===s.RG_INTEGER&&(k===s.UNSIGNED_BYTE&&(Y=s.RG8UI),k===s.UNSIGNED_SHORT&&(Y=s.RG16UI),k===s.UNSIGNED_INT&&(Y=s.RG32UI),k===s.BYTE&&(Y=s.RG8I),k===s.SHORT&&(Y=s.RG16I),k===s.INT&&(Y=s.RG32I)),v===s.RGB_INTEGER&&(k===s.UNSIGNED_BYTE&&(Y=s.RGB8UI),k===s.UNSIGNED_SHORT&&(Y=s.RGB16UI),k===s.UNSIGNED_INT&&(Y=s.RGB32UI),k===s.BYTE&&(Y=s.RGB8I),k===s.SHORT&&(Y=s.RGB16I),k===s.INT&&(Y=s.RGB32I)),v===s.RGBA_INTEGER&&(k===s.UNSIGNED_BYTE&&(Y=s.RGBA8UI),k===s.UNSIGNED_SHORT&&(Y=s.RGBA16UI),k===s.UNSIGNED_INT&&(Y=s.RGBA32UI),k===s.BYTE&&(Y=s.RGBA8I),k===s.SHORT&&(Y=s.RGBA16I),k===s.INT&&(Y=s.RGBA32I)),v===s.RGB&&(k===s.UNSIGNED_SHORT&&pt&&(Y=pt.RGB16_EXT),k===s.SHORT&&pt&&(Y=pt.RGB16_SNORM_EXT),k===s.UNSIGNED_INT_5_9_9_9_REV&&(Y=s.RGB9_E5),k===s.UNSIGNED_INT_10F_11F_11F_REV&&(Y=s.R11F_G11F_B10F)),v===s.RGBA){let Z=ot?Mr:ne.getTransfer(j);k===s.FLOAT&&(Y=s.RGBA32F),k===s.HALF_FLOAT&&(Y=s.RGBA16F),k===s.UNSIGNED_BYTE&&(Y=Z===le?s.SRGB8_ALPHA8:s.RGBA8),k===s.UNSIGNED_SHORT&&pt&&(Y=pt.RGBA16_EXT),k===s.SHORT&&pt&&(Y=pt.RGBA16_SNORM_EXT),k===s.UNSIGNED_SHORT_4_4_4_4&&(Y=s.RGBA4),k===s.UNSIGNED_SHORT_5_5_5_1&&(Y=s.RGB5_A1)}return(Y===s.R16F||Y===s.R32F||Y===s.RG16F||Y===s.RG32F||Y===s.RGBA16F||Y===s.RGBA32F)&&t.get("EXT_color_buffer_float"),Y}function x(w,v){let k;return w?v===null||v===Ti||v===ts?k=s.DEPTH24_STENCIL8:v===xi?k=s.DEPTH32F_STENCIL8:v===zs&&(k=s.DEPTH24_STENCIL8,kt("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):v===null||v===Ti||v===ts?k=s.DEPTH_COMPONENT24:v===xi?k=s.DEPTH_COMPONENT32F:v===zs&&(k=s.DEPTH_COMPONENT16),k}function S(w,v){return E(w)===!0||w.isFramebufferTexture&&w.minFilter!==Fe&&w.minFilter!==Je?Math.log2(Math.max(v.width,v.height))+1:w.mipmaps.length>0?w.mipmaps.length:w.isCompressedTexture&&Array.isArray(w.image)?v.mipmaps.length:1}function U(w){let v=new WeakRef(w);i.get(w).__ref=v,p.add(v),_.register(w,v,v)}function I(w){let v=i.get(w).__ref;v!==void 0&&(p.delete(v),_.unregister(v))}function D(w){H(w.target)}function F(w){C(w.target)}function H(w){w.removeEventListener("dispose",D),I(w),X(w),w.isVideoTexture&&h.delete(w),w.isHTMLTexture&&u.delete(w)}function C(w){w.removeEventListener("dispose",F),I(w),et(w)}function z(){for(let w of p){let v=w.deref();v!==void 0&&(v.isRenderTarget===!0?C(v):H(v))}p.clear(),u.clear()}function X(w){let v=i.get(w);if(v.__webglInit===void 0)return;let k=w.source,it=f.get(k);if(it){let j=it[v.__cacheKey];j.usedTimes--,j.usedTimes===0&&G(w),Object.keys(it).length===0&&f.delete(k)}i.remove(w)}function G(w){let v=i.get(w);s.deleteTexture(v.__webglTexture);let k=w.source,it=f.get(k);delete it[v.__cacheKey],o.memory.textures--}function et(w){let v=i.get(w);v.__depthDisposeCallback&&v.__depthDisposeCallback();let k=w.depthTexture;if(k&&k.renderTarget===w&&H(k),w.isWebGLCubeRenderTarget)for(let j=0;j<6;j++){if(Array.isArray(v.__webglFramebuffer[j]))for(let ot=0;ot<v.__webglFramebuffer[j].length;ot++)s.deleteFramebuffer(v.__webglFramebuffer[j][ot]);else s.deleteFramebuffer(v.__webglFramebuffer[j]);v.__webglDepthbuffer&&s.deleteRenderbuffer(v.__webglDepthbuffer[j])}else{if(Array.isArray(v.__webglFramebuffer))for(let j=0;j<v.__webglFramebuffer.length;j++)s.deleteFramebuffer(v.__webglFramebuffer[j]);else s.deleteFramebuffer(v.__webglFramebuffer);if(v.__webglDepthbuffer&&s.deleteRenderbuffer(v.__webglDepthbuffer),v.__webglMultisampledFramebuffer&&s.deleteFramebuffer(v.__webglMultisampledFramebuffer),v.__webglColorRenderbuffer)for(let j=0;j<v.__webglColorRenderbuffer.length;j++)v.__webglColorRenderbuffer[j]&&s.deleteRenderbuffer(v.__webglColorRenderbuffer[j]);v.__webglDepthRenderbuffer&&s.deleteRenderbuffer(v.__webglDepthRenderbuffer)}let it=w.textures;for(let j=0,ot=it.length;j<ot;j++){let pt=i.get(it[j]);pt.__webglTexture&&(s.deleteTexture(pt.__webglTexture),o.memory.textures--),i.remove(it[j])}i.remove(w)}let W=0;function K(){W=0}function tt(){return W}function St(w){W=w}function Ot(){let w=W;return w>=n.maxTextures&&kt("WebGLTextures: Trying to use "+(w+1)+" texture units while this GPU supports only "+n.maxTextures),W+=1,w}function $(w){let v=[];return v.push(w.wrapS),v.push(w.wrapT),v.push(w.wrapR||0),v.push(w.magFilter),v.push(w.minFilter),v.push(w.anisotropy),v.push(w.internalFormat),v.push(w.format),v.push(w.type),v.push(w.generateMipmaps),v.push(w.mipmapsAutoUpdate),v.push(w.premultiplyAlpha),v.push(w.flipY),v.push(w.unpackAlignment),v.push(w.colorSpace),v.join()}function xt(w,v){let k=i.get(w);if(w.isVideoTexture&&ve(w),w.isRenderTargetTexture===!1&&w.isExternalTexture!==!0&&w.version>0&&k.__version!==w.version){let it=w.image;if(it===null)kt("WebGLRenderer: Texture marked for update but no image data found.");else if(it.complete===!1)kt("WebGLRenderer: Texture marked for update but image is incomplete");else{rt(k,w,v);return}}else w.isExternalTexture&&(k.__webglTexture=w.sourceTexture?w.sourceTexture:null);e.bindTexture(s.TEXTURE_2D,k.__webglTexture,s.TEXTURE0+v)}function wt(w,v){let k=i.get(w);if(w.isRenderTargetTexture===!1&&w.version>0&&k.__version!==w.version){rt(k,w,v);return}else w.isExternalTexture&&(k.__webglTexture=w.sourceTexture?w.sourceTexture:null);e.bindTexture(s.TEXTURE_2D_ARRAY,k.__webglTexture,s.TEXTURE0+v)}function Nt(w,v){let k=i.get(w);if(w.isRenderTargetTexture===!1&&w.version>0&&k.__version!==w.version){rt(k,w,v);return}e.bindTexture(s.TEXTURE_3D,k.__webglTexture,s.TEXTURE0+v)}function _t(w,v){let k=i.get(w);if(w.version>0&&k.__version!==w.version){Mt(k,w,v);return}e.bindTexture(s.TEXTURE_CUBE_MAP,k.__webglTexture,s.TEXTURE0+v)}let Dt={[Oa]:s.REPEAT,[Ui]:s.CLAMP_TO_EDGE,[Fa]:s.MIRRORED_REPEAT},pe={[Fe]:s.NEAREST,[xp]:s.NEAREST_MIPMAP_NEAREST,[so]:s.NEAREST_MIPMAP_LINEAR,[Je]:s.LINEAR,[_l]:s.LINEAR_MIPMAP_NEAREST,[rn]:s.LINEAR_MIPMAP_LINEAR},Ft={[bp]:s.NEVER,[gu]:s.ALWAYS,[Mp]:s.LESS,[pu]:s.LEQUAL,[Sp]:s.EQUAL,[mu]:s.GEQUAL,[wp]:s.GREATER,[Ep]:s.NOTEQUAL};function Zt(w,v){if(v.type===xi&&t.has("OES_texture_float_linear")===!1&&(v.magFilter===Je||v.magFilter===_l||v.magFilter===so||v.magFilter===rn||v.minFilter===Je||v.minFilter===_l||v.minFilter===so||v.minFilter===rn)&&kt("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),s.texParameteri(w,s.TEXTURE_WRAP_S,Dt[v.wrapS]),s.texParameteri(w,s.TEXTURE_WRAP_T,Dt[v.wrapT]),(w===s.TEXTURE_3D||w===s.TEXTURE_2D_ARRAY)&&s.texParameteri(w,s.TEXTURE_WRAP_R,Dt[v.wrapR]),s.texParameteri(w,s.TEXTURE_MAG_FILTER,pe[v.magFilter]),s.texParameteri(w,s.TEXTURE_MIN_FILTER,pe[v.minFilter]),v.compareFunction&&(s.texParameteri(w,s.TEXTURE_COMPARE_MODE,s.COMPARE_REF_TO_TEXTURE),s.texParameteri(w,s.TEXTURE_COMPARE_FUNC,Ft[v.compareFunction])),t.has("EXT_texture_filter_anisotropic")===!0){if(v.magFilter===Fe||v.minFilter!==so&&v.minFilter!==rn||v.type===xi&&t.has("OES_texture_float_linear")===!1)return;if(v.anisotropy>1||i.get(v).__currentAnisotropy){let k=t.get("EXT_texture_filter_anisotropic");s.texParameterf(w,k.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(v.anisotropy,n.getMaxAnisotropy())),i.get(v).__currentAnisotropy=v.anisotropy}}}function jt(w,v){let k=!1;w.__webglInit===void 0&&(w.__webglInit=!0,v.addEventListener("dispose",D),U(v));let it=v.source,j=f.get(it);j===void 0&&(j={},f.set(it,j));let ot=$(v);if(ot!==w.__cacheKey){j[ot]===void 0&&(j[ot]={texture:s.createTexture(),usedTimes:0},o.memory.textures++,k=!0),j[ot].usedTimes++;let pt=j[w.__cacheKey];pt!==void 0&&(j[w.__cacheKey].usedTimes--,pt.usedTimes===0&&G(v)),w.__cacheKey=ot,w.__webglTexture=j[ot].texture}return k}function Q(w,v,k){return Math.floor(Math.floor(w/k)/v)}function ct(w,v,k,it){let ot=w.updateRanges;if(ot.length===0)e.texSubImage2D(s.TEXTURE_2D,0,0,0,v.width,v.height,k,it,v.data);else{ot.sort((R,J)=>R.start-J.start);let pt=0;for(let R=1;R<ot.length;R++){let J=ot[pt],q=ot[R],ut=J.start+J.count,st=Q(q.start,v.width,4),at=Q(J.start,v.width,4);q.start<=ut+1&&st===at&&Q(q.start+q.count-1,v.width,4)===st?J.count=Math.max(J.count,q.start+q.count-J.start):(++pt,ot[pt]=q)}ot.length=pt+1;let Y=e.getParameter(s.UNPACK_ROW_LENGTH),Z=e.getParameter(s.UNPACK_SKIP_PIXELS),ht=e.getParameter(s.UNPACK_SKIP_ROWS);e.pixelStorei(s.UNPACK_ROW_LENGTH,v.width);for(let R=0,J=ot.length;R<J;R++){let q=ot[R],ut=Math.floor(q.start/4),st=Math.ceil(q.count/4),at=ut%v.width,Pt=Math.floor(ut/v.width),$t=st,nt=1;e.pixelStorei(s.UNPACK_SKIP_PIXELS,at),e.pixelStorei(s.UNPACK_SKIP_ROWS,Pt),e.texSubImage2D(s.TEXTURE_2D,0,at,Pt,$t,nt,k,it,v.data)}w.clearUpdateRanges(),e.pixelStorei(s.UNPACK_ROW_LENGTH,Y),e.pixelStorei(s.UNPACK_SKIP_PIXELS,Z),e.pixelStorei(s.UNPACK_SKIP_ROWS,ht)}}function rt(w,v,k){let it=s.TEXTURE_2D;(v.isDataArrayTexture||v.isCompressedArrayTexture)&&(it=s.TEXTURE_2D_ARRAY),v.isData3DTexture&&(it=s.TEXTURE_3D);let j=jt(w,v),ot=v.source;e.bindTexture(it,w.__webglTexture,s.TEXTURE0+k);let pt=i.get(ot);if(ot.version!==pt.__version||j===!0){if(e.activeTexture(s.TEXTURE0+k),(typeof ImageBitmap<"u"&&v.image instanceof ImageBitmap)===!1){let nt=ne.getPrimaries(ne.workingColorSpace),Lt=v.colorSpace===an?null:ne.getPrimaries(v.colorSpace),Xt=v.colorSpace===an||nt===Lt?s.NONE:s.BROWSER_DEFAULT_WEBGL;e.pixelStorei(s.UNPACK_FLIP_Y_WEBGL,v.flipY),e.pixelStorei(s.UNPACK_PREMULTIPLY_ALPHA_WEBGL,v.premultiplyAlpha),e.pixelStorei(s.UNPACK_COLORSPACE_CONVERSION_WEBGL,Xt)}e.pixelStorei(s.UNPACK_ALIGNMENT,v.unpackAlignment);let Z=b(v.image,!1,n.maxTextureSize);Z=Ut(v,Z);let ht=r.convert(v.format,v.colorSpace),R=r.convert(v.type),J=A(v.internalFormat,ht,R,v.normalized,v.colorSpace,v.isVideoTexture);Zt(it,v);let q,ut=v.mipmaps,st=v.isVideoTexture!==!0,at=pt.__version===void 0||j===!0,Pt=ot.dataReady,$t=S(v,Z);if(v.isDepthTexture)J=x(v.format===on,v.type),at&&(st?e.texStorage2D(s.TEXTURE_2D,1,J,Z.width,Z.height):e.texImage2D(s.TEXTURE_2D,0,J,Z.width,Z.height,0,ht,R,null));else if(v.isDataTexture)if(ut.length>0){st&&at&&e.texStorage2D(s.TEXTURE_2D,$t,J,ut[0].width,ut[0].height);for(let nt=0,Lt=ut.length;nt<Lt;nt++)q=ut[nt],st?Pt&&e.texSubImage2D(s.TEXTURE_2D,nt,0,0,q.width,q.height,ht,R,q.data):e.texImage2D(s.TEXTURE_2D,nt,J,q.width,q.height,0,ht,R,q.data);v.generateMipmaps=!1}else st?(at&&e.texStorage2D(s.TEXTURE_2D,$t,J,Z.width,Z.height),Pt&&ct(v,Z,ht,R)):e.texImage2D(s.TEXTURE_2D,0,J,Z.width,Z.height,0,ht,R,Z.data);else if(v.isCompressedTexture)if(v.isCompressedArrayTexture){st&&at&&e.texStorage3D(s.TEXTURE_2D_ARRAY,$t,J,ut[0].width,ut[0].height,Z.depth);for(let nt=0,Lt=ut.length;nt<Lt;nt++)if(q=ut[nt],v.format!==Ci)if(ht!==null)if(st){if(Pt)if(v.layerUpdates.size>0){let Xt=Su(q.width,q.height,v.format,v.type);for(let vt of v.layerUpdates){let ce=q.data.subarray(vt*Xt/q.data.BYTES_PER_ELEMENT,(vt+1)*Xt/q.data.BYTES_PER_ELEMENT);e.compressedTexSubImage3D(s.TEXTURE_2D_ARRAY,nt,0,0,vt,q.width,q.height,1,ht,ce)}}else e.compressedTexSubImage3D(s.TEXTURE_2D_ARRAY,nt,0,0,0,q.width,q.height,Z.depth,ht,q.data)}else e.compressedTexImage3D(s.TEXTURE_2D_ARRAY,nt,J,q.width,q.height,Z.depth,0,q.data,0,0);else kt("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else st?Pt&&e.texSubImage3D(s.TEXTURE_2D_ARRAY,nt,0,0,0,q.width,q.height,Z.depth,ht,R,q.data):e.texImage3D(s.TEXTURE_2D_ARRAY,nt,J,q.width,q.height,Z.depth,0,ht,R,q.data);v.layerUpdates.size>0&&v.clearLayerUpdates()}else{st&&at&&e.texStorage2D(s.TEXTURE_2D,$t,J,ut[0].width,ut[0].height);for(let nt=0,Lt=ut.length;nt<Lt;nt++)q=ut[nt],v.format!==Ci?ht!==null?st?Pt&&e.compressedTexSubImage2D(s.TEXTURE_2D,nt,0,0,q.width,q.height,ht,q.data):e.compressedTexImage2D(s.TEXTURE_2D,nt,J,q.width,q.height,0,q.data):kt("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):st?Pt&&e.texSubImage2D(s.TEXTURE_2D,nt,0,0,q.width,q.height,ht,R,q.data):e.texImage2D(s.TEXTURE_2D,nt,J,q.width,q.height,0,ht,R,q.data)}else if(v.isDataArrayTexture)if(st){if(at&&e.texStorage3D(s.TEXTURE_2D_ARRAY,$t,J,Z.width,Z.height,Z.depth),Pt)if(v.layerUpdates.size>0){let nt=Su(Z.width,Z.height,v.format,v.type);for(let Lt of v.layerUpdates){let Xt=Z.data.subarray(Lt*nt/Z.data.BYTES_PER_ELEMENT,(Lt+1)*nt/Z.data.BYTES_PER_ELEMENT);e.texSubImage3D(s.TEXTURE_2D_ARRAY,0,0,0,Lt,Z.width,Z.height,1,ht,R,Xt)}v.clearLayerUpdates()}else e.texSubImage3D(s.TEXTURE_2D_ARRAY,0,0,0,0,Z.width,Z.height,Z.depth,ht,R,Z.data)}else e.texImage3D(s.TEXTURE_2D_ARRAY,0,J,Z.width,Z.height,Z.depth,0,ht,R,Z.data);else if(v.isData3DTexture)st?(at&&e.texStorage3D(s.TEXTURE_3D,$t,J,Z.width,Z.height,Z.depth),Pt&&e.texSubImage3D(s.TEXTURE_3D,0,0,0,0,Z.width,Z.height,Z.depth,ht,R,Z.data)):e.texImage3D(s.TEXTURE_3D,0,J,Z.width,Z.height,Z.depth,0,ht,R,Z.data);else if(v.isFramebufferTexture){if(at)if(st)e.texStorage2D(s.TEXTURE_2D,$t,J,Z.width,Z.height);else{let nt=Z.width,Lt=Z.height;for(let Xt=0;Xt<$t;Xt++)e.texImage2D(s.TEXTURE_2D,Xt,J,nt,Lt,0,ht,R,null),nt>>=1,Lt>>=1}}else if(v.isHTMLTexture){if("texElementImage2D"in s){let nt=s.canvas;if(nt.hasAttribute("layoutsubtree")||nt.setAttribute("layoutsubtree","true"),Z.parentNode!==nt){nt.appendChild(Z),u.add(v),nt.onpaint=Lt=>{let Xt=Lt.changedElements;for(let vt of u)Xt.includes(vt.image)&&(vt.needsUpdate=!0)},nt.requestPaint();return}if(s.texElementImage2D.length===3)s.texElementImage2D(s.TEXTURE_2D,s.RGBA8,Z);else{let Xt=s.RGBA,vt=s.RGBA,ce=s.UNSIGNED_BYTE;s.texElementImage2D(s.TEXTURE_2D,0,Xt,vt,ce,Z)}s.texParameteri(s.TEXTURE_2D,s.TEXTURE_MIN_FILTER,s.LINEAR),s.texParameteri(s.TEXTURE_2D,s.TEXTURE_WRAP_S,s.CLAMP_TO_EDGE),s.texParameteri(s.TEXTURE_2D,s.TEXTURE_WRAP_T,s.CLAMP_TO_EDGE)}}else if(ut.length>0){if(st&&at){let nt=zt(ut[0]);e.texStorage2D(s.TEXTURE_2D,$t,J,nt.width,nt.height)}for(let nt=0,Lt=ut.length;nt<Lt;nt++)q=ut[nt],st?Pt&&e.texSubImage2D(s.TEXTURE_2D,nt,0,0,ht,R,q):e.texImage2D(s.TEXTURE_2D,nt,J,ht,R,q);v.generateMipmaps=!1}else if(st){if(at){let nt=zt(Z);e.texStorage2D(s.TEXTURE_2D,$t,J,nt.width,nt.height)}Pt&&e.texSubImage2D(s.TEXTURE_2D,0,0,0,ht,R,Z)}else e.texImage2D(s.TEXTURE_2D,0,J,ht,R,Z);E(v)&&v.mipmapsAutoUpdate===!0&&M(it),pt.__version=ot.version,v.onUpdate&&v.onUpdate(v)}w.__version=v.version}function Mt(w,v,k){if(v.image.length!==6)return;let it=jt(w,v),j=v.source;e.bindTexture(s.TEXTURE_CUBE_MAP,w.__webglTexture,s.TEXTURE0+k);let ot=i.get(j);if(j.version!==ot.__version||it===!0){e.activeTexture(s.TEXTURE0+k);let pt=ne.getPrimaries(ne.workingColorSpace),Y=v.colorSpace===an?null:ne.getPrimaries(v.colorSpace),Z=v.colorSpace===an||pt===Y?s.NONE:s.BROWSER_DEFAULT_WEBGL;e.pixelStorei(s.UNPACK_FLIP_Y_WEBGL,v.flipY),e.pixelStorei(s.UNPACK_PREMULTIPLY_ALPHA_WEBGL,v.premultiplyAlpha),e.pixelStorei(s.UNPACK_ALIGNMENT,v.unpackAlignment),e.pixelStorei(s.UNPACK_COLORSPACE_CONVERSION_WEBGL,Z);let ht=v.isCompressedTexture||v.image[0].isCompressedTexture,R=v.image[0]&&v.image[0].isDataTexture,J=[];for(let vt=0;vt<6;vt++)!ht&&!R?J[vt]=b(v.image[vt],!0,n.maxCubemapSize):J[vt]=R?v.image[vt].image:v.image[vt],J[vt]=Ut(v,J[vt]);let q=J[0],ut=r.convert(v.format,v.colorSpace),st=r.convert(v.type),at=A(v.internalFormat,ut,st,v.normalized,v.colorSpace),Pt=v.isVideoTexture!==!0,$t=ot.__version===void 0||it===!0,nt=j.dataReady,Lt=S(v,q);Zt(s.TEXTURE_CUBE_MAP,v);let Xt;if(v.isDepthTexture){if(at=x(v.format===on,v.type),$t)if(Pt)e.texStorage2D(s.TEXTURE_CUBE_MAP,1,at,q.width,q.height);else for(let vt=0;vt<6;vt++)e.texImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,0,at,q.width,q.height,0,ut,st,null)}else if(ht){Pt&&$t&&e.texStorage2D(s.TEXTURE_CUBE_MAP,Lt,at,q.width,q.height);for(let vt=0;vt<6;vt++){Xt=J[vt].mipmaps;for(let ce=0;ce<Xt.length;ce++){let Ne=Xt[ce];v.format!==Ci?ut!==null?Pt?nt&&e.compressedTexSubImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,ce,0,0,Ne.width,Ne.height,ut,Ne.data):e.compressedTexImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,ce,at,Ne.width,Ne.height,0,Ne.data):kt("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):Pt?nt&&e.texSubImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,ce,0,0,Ne.width,Ne.height,ut,st,Ne.data):e.texImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,ce,at,Ne.width,Ne.height,0,ut,st,Ne.data)}}}else{if(Xt=v.mipmaps,Pt&&$t){Xt.length>0&&Lt++;let vt=zt(J[0]);e.texStorage2D(s.TEXTURE_CUBE_MAP,Lt,at,vt.width,vt.height)}for(let vt=0;vt<6;vt++)if(R){Pt?nt&&e.texSubImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,0,0,0,J[vt].width,J[vt].height,ut,st,J[vt].data):e.texImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,0,at,J[vt].width,J[vt].height,0,ut,st,J[vt].data);for(let ce=0;ce<Xt.length;ce++){let cn=Xt[ce].image[vt].image;Pt?nt&&e.texSubImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,ce+1,0,0,cn.width,cn.height,ut,st,cn.data):e.texImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,ce+1,at,cn.width,cn.height,0,ut,st,cn.data)}}else{Pt?nt&&e.texSubImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,0,0,0,ut,st,J[vt]):e.texImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,0,at,ut,st,J[vt]);for(let ce=0;ce<Xt.length;ce++){let Ne=Xt[ce];Pt?nt&&e.texSubImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,ce+1,0,0,ut,st,Ne.image[vt]):e.texImage2D(s.TEXTURE_CUBE_MAP_POSITIVE_X+vt,ce+1,at,ut,st,Ne.image[vt])}}}E(v)&&v.mipmapsAutoUpdate===!0&&M(s.TEXTURE_CUBE_MAP),ot.__version=j.version,v.onUpdate&&v.onUpdate(v)}w.__version=v.version}function gt(w,v,k,it,j,ot){let pt=r.convert(k.format,k.colorSpace),Y=r.convert(k.type),Z=A(k.internalFormat,pt,Y,k.normalized,k.colorSpace),ht=i.get(v),R=i.get(k);if(R.__renderTarget=v,!ht.__hasExternalTextures){let J=Math.max(1,v.width>>ot),q=Math.max(1,v.height>>ot);j===s.TEXTURE_3D||j===s.TEXTURE_2D_ARRAY?e.texImage3D(j,ot,Z,J,q,v.depth,0,pt,Y,null):e.texImage2D(j,ot,Z,J,q,0,pt,Y,null)}e.bindFramebuffer(s.FRAMEBUFFER,w),ft(v)?a.framebufferTexture2DMultisampleEXT(s.FRAMEBUFFER,it,j,R.__webglTexture,0,he(v)):(j===s.TEXTURE_2D||j>=s.TEXTURE_CUBE_MAP_POSITIVE_X&&j<=s.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&s.framebufferTexture2D(s.FRAMEBUFFER,it,j,R.__webglTexture,ot),e.bindFramebuffer(s.FRAMEBUFFER,null)}function Ht(w,v,k){if(s.bindRenderbuffer(s.RENDERBUFFER,w),v.depthBuffer){let it=v.depthTexture,j=it&&it.isDepthTexture?it.type:null,ot=x(v.stencilBuffer,j),pt=v.stencilBuffer?s.DEPTH_STENCIL_ATTACHMENT:s.DEPTH_ATTACHMENT;ft(v)?a.renderbufferStorageMultisampleEXT(s.RENDERBUFFER,he(v),ot,v.width,v.height):k?s.renderbufferStorageMultisample(s.RENDERBUFFER,he(v),ot,v.width,v.height):s.renderbufferStorage(s.RENDERBUFFER,ot,v.width,v.height),s.framebufferRenderbuffer(s.FRAMEBUFFER,pt,s.RENDERBUFFER,w)}else{let it=v.textures;for(let j=0;j<it.length;j++){let ot=it[j],pt=r.convert(ot.format,ot.colorSpace),Y=r.convert(ot.type),Z=A(ot.internalFormat,pt,Y,ot.normalized,ot.colorSpace);ft(v)?a.renderbufferStorageMultisampleEXT(s.RENDERBUFFER,he(v),Z,v.width,v.height):k?s.renderbufferStorageMultisample(s.RENDERBUFFER,he(v),Z,v.width,v.height):s.renderbufferStorage(s.RENDERBUFFER,Z,v.width,v.height)}}s.bindRenderbuffer(s.RENDERBUFFER,null)}function It(w,v,k){let it=v.isWebGLCubeRenderTarget===!0;if(e.bindFramebuffer(s.FRAMEBUFFER,w),!(v.depthTexture&&v.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let j=i.get(v.depthTexture);j.__renderTarget=v;let ot=it?v.depthTexture.image[0]:v.depthTexture.image;(!j.__webglTexture||ot.width!==v.width||ot.height!==v.height)&&(ot.width=v.width,ot.height=v.height,v.depthTexture.needsUpdate=!0),it?_t(v.depthTexture,0):xt(v.depthTexture,0);let pt=j.__webglTexture,Y=he(v),Z=it?s.TEXTURE_CUBE_MAP_POSITIVE_X+k:s.TEXTURE_2D,ht=v.depthTexture.format===on?s.DEPTH_STENCIL_ATTACHMENT:s.DEPTH_ATTACHMENT;if(v.depthTexture.format===en)ft(v)?a.framebufferTexture2DMultisampleEXT(s.FRAMEBUFFER,ht,Z,pt,0,Y):s.framebufferTexture2D(s.FRAMEBUFFER,ht,Z,pt,0);else if(v.depthTexture.format===on)ft(v)?a.framebufferTexture2DMultisampleEXT(s.FRAMEBUFFER,ht,Z,pt,0,Y):s.framebufferTexture2D(s.FRAMEBUFFER,ht,Z,pt,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function Kt(w){let v=i.get(w),k=w.isWebGLCubeRenderTarget===!0;if(v.__boundDepthTexture!==w.depthTexture){let it=w.depthTexture;if(v.__depthDisposeCallback&&v.__depthDisposeCallback(),it){let j=()=>{delete v.__boundDepthTexture,delete v.__depthDisposeCallback,it.removeEventListener("dispose",j)};it.addEventListener("dispose",j),v.__depthDisposeCallback=j}v.__boundDepthTexture=it}if(w.depthTexture&&!v.__autoAllocateDepthBuffer)if(k)for(let it=0;it<6;it++)It(v.__webglFramebuffer[it],w,it);else w.texture.mipmaps.length>0?It(v.__webglFramebuffer[0],w,0):It(v.__webglFramebuffer,w,0);else if(k){v.__webglDepthbuffer=[];for(let it=0;it<6;it++)if(e.bindFramebuffer(s.FRAMEBUFFER,v.__webglFramebuffer[it]),v.__webglDepthbuffer[it]===void 0)v.__webglDepthbuffer[it]=s.createRenderbuffer(),Ht(v.__webglDepthbuffer[it],w,!1);else{let j=w.stencilBuffer?s.DEPTH_STENCIL_ATTACHMENT:s.DEPTH_ATTACHMENT,ot=v.__webglDepthbuffer[it];s.bindRenderbuffer(s.RENDERBUFFER,ot),s.framebufferRenderbuffer(s.FRAMEBUFFER,j,s.RENDERBUFFER,ot)}}else if(w.texture.mipmaps.length>0?e.bindFramebuffer(s.FRAMEBUFFER,v.__webglFramebuffer[0]):e.bindFramebuffer(s.FRAMEBUFFER,v.__webglFramebuffer),v.__webglDepthbuffer===void 0)v.__webglDepthbuffer=s.createRenderbuffer(),Ht(v.__webglDepthbuffer,w,!1);else{let j=w.stencilBuffer?s.DEPTH_STENCIL_ATTACHMENT:s.DEPTH_ATTACHMENT,ot=v.__webglDepthbuffer;s.bindRenderbuffer(s.RENDERBUFFER,ot),s.framebufferRenderbuffer(s.FRAMEBUFFER,j,s.RENDERBUFFER,ot)}e.bindFramebuffer(s.FRAMEBUFFER,null)}function te(w,v,k){let it=i.get(w);v!==void 0&&gt(it.__webglFramebuffer,w,w.texture,s.COLOR_ATTACHMENT0,s.TEXTURE_2D,0),k!==void 0&&Kt(w)}function oe(w){let v=w.texture,k=i.get(w),it=i.get(v);w.addEventListener("dispose",F),U(w);let j=w.textures,ot=w.isWebGLCubeRenderTarget===!0,pt=j.length>1;if(pt||(it.__webglTexture===void 0&&(it.__webglTexture=s.createTexture()),it.__version=v.version,o.memory.textures++),ot){k.__webglFramebuffer=[];for(let Y=0;Y<6;Y++)if(v.mipmaps.length>0){k.__webglFramebuffer[Y]=[];for(let Z=0;Z<v.mipmaps.length;Z++)k.__webglFramebuffer[Y][Z]=s.createFramebuffer()}else k.__webglFramebuffer[Y]=s.createFramebuffer()}else{if(v.mipmaps.length>0){k.__webglFramebuffer=[];for(let Y=0;Y<v.mipmaps.length;Y++)k.__webglFramebuffer[Y]=s.createFramebuffer()}else k.__webglFramebuffer=s.createFramebuffer();if(pt)for(let Y=0,Z=j.length;Y<Z;Y++){let ht=i.get(j[Y]);ht.__webglTexture===void 0&&(ht.__webglTexture=s.createTexture(),o.memory.textures++)}if(w.samples>0&&ft(w)===!1){k.__webglMultisampledFramebuffer=s.createFramebuffer(),k.__webglColorRenderbuffer=[],e.bindFramebuffer(s.FRAMEBUFFER,k.__webglMultisampledFramebuffer);for(let Y=0;Y<j.length;Y++){let Z=j[Y];k.__webglColorRenderbuffer[Y]=s.createRenderbuffer(),s.bindRenderbuffer(s.RENDERBUFFER,k.__webglColorRenderbuffer[Y]);let ht=r.convert(Z.format,Z.colorSpace),R=r.convert(Z.type),J=A(Z.internalFormat,ht,R,Z.normalized,Z.colorSpace,w.isXRRenderTarget===!0),q=he(w);s.renderbufferStorageMultisample(s.RENDERBUFFER,q,J,w.width,w.height),s.framebufferRenderbuffer(s.FRAMEBUFFER,s.COLOR_ATTACHMENT0+Y,s.RENDERBUFFER,k.__webglColorRenderbuffer[Y])}s.bindRenderbuffer(s.RENDERBUFFER,null),w.depthBuffer&&(k.__webglDepthRenderbuffer=s.createRenderbuffer(),Ht(k.__webglDepthRenderbuffer,w,!0)),e.bindFramebuffer(s.FRAMEBUFFER,null)}}if(ot){e.bindTexture(s.TEXTURE_CUBE_MAP,it.__webglTexture),Zt(s.TEXTURE_CUBE_MAP,v);for(let Y=0;Y<6;Y++)if(v.mipmaps.length>0)for(let Z=0;Z<v.mipmaps.length;Z++)gt(k.__webglFramebuffer[Y][Z],w,v,s.COLOR_ATTACHMENT0,s.TEXTURE_CUBE_MAP_POSITIVE_X+Y,Z);else gt(k.__webglFramebuffer[Y],w,v,s.COLOR_ATTACHMENT0,s.TEXTURE_CUBE_MAP_POSITIVE_X+Y,0);E(v)?M(s.TEXTURE_CUBE_MAP):v.mipmaps.length>0&&s.texParameteri(s.TEXTURE_CUBE_MAP,s.TEXTURE_MAX_LEVEL,v.mipmaps.length-1),e.unbindTexture()}else if(pt){for(let Y=0,Z=j.length;Y<Z;Y++){let ht=j[Y],R=i.get(ht),J=s.TEXTURE_2D;(w.isWebGL3DRenderTarget||w.isWebGLArrayRenderTarget)&&(J=w.isWebGL3DRenderTarget?s.TEXTURE_3D:s.TEXTURE_2D_ARRAY),e.bindTexture(J,R.__webglTexture),Zt(J,ht),gt(k.__webglFramebuffer,w,ht,s.COLOR_ATTACHMENT0+Y,J,0),E(ht)&&M(J)}e.unbindTexture()}else{let Y=s.TEXTURE_2D;if((w.isWebGL3DRenderTarget||w.isWebGLArrayRenderTarget)&&(Y=w.isWebGL3DRenderTarget?s.TEXTURE_3D:s.TEXTURE_2D_ARRAY),e.bindTexture(Y,it.__webglTexture),Zt(Y,v),v.mipmaps.length>0)for(let Z=0;Z<v.mipmaps.length;Z++)gt(k.__webglFramebuffer[Z],w,v,s.COLOR_ATTACHMENT0,Y,Z);else gt(k.__webglFramebuffer,w,v,s.COLOR_ATTACHMENT0,Y,0);E(v)?M(Y):v.mipmaps.length>0&&s.texParameteri(Y,s.TEXTURE_MAX_LEVEL,v.mipmaps.length-1),e.unbindTexture()}w.depthBuffer&&Kt(w)}function N(w){let v=w.textures;for(let k=0,it=v.length;k<it;k++){let j=v[k];if(E(j)&&j.mipmapsAutoUpdate===!0){let ot=T(w),pt=i.get(j).__webglTexture;e.bindTexture(ot,pt),M(ot),e.unbindTexture()}}}let Ee=[];function Jt(w){if(w.samples>0){if(ft(w)===!1){let v=w.textures,k=w.width,it=w.height,j=s.COLOR_BUFFER_BIT,ot=w.stencilBuffer?s.DEPTH_STENCIL_ATTACHMENT:s.DEPTH_ATTACHMENT,pt=i.get(w),Y=v.length>1;if(Y)for(let ht=0;ht<v.length;ht++)e.bindFramebuffer(s.FRAMEBUFFER,pt.__webglMultisampledFramebuffer),s.framebufferRenderbuffer(s.FRAMEBUFFER,s.COLOR_ATTACHMENT0+ht,s.RENDERBUFFER,null),e.bindFramebuffer(s.FRAMEBUFFER,pt.__webglFramebuffer),s.framebufferTexture2D(s.DRAW_FRAMEBUFFER,s.COLOR_ATTACHMENT0+ht,s.TEXTURE_2D,null,0);e.bindFramebuffer(s.READ_FRAMEBUFFER,pt.__webglMultisampledFramebuffer),w.texture.mipmaps.length>0?e.bindFramebuffer(s.DRAW_FRAMEBUFFER,pt.__webglFramebuffer[0]):e.bindFramebuffer(s.DRAW_FRAMEBUFFER,pt.__webglFramebuffer);for(let ht=0;ht<v.length;ht++){if(w.resolveDepthBuffer&&(w.depthBuffer&&(j|=s.DEPTH_BUFFER_BIT),w.stencilBuffer&&w.resolveStencilBuffer&&(j|=s.STENCIL_BUFFER_BIT)),Y){s.framebufferRenderbuffer(s.READ_FRAMEBUFFER,s.COLOR_ATTACHMENT0,s.RENDERBUFFER,pt.__webglColorRenderbuffer[ht]);let R=i.get(v[ht]).__webglTexture;s.framebufferTexture2D(s.DRAW_FRAMEBUFFER,s.COLOR_ATTACHMENT0,s.TEXTURE_2D,R,0)}s.blitFramebuffer(0,0,k,it,0,0,k,it,j,s.NEAREST),l===!0&&(Ee.length=0,Ee.push(s.COLOR_ATTACHMENT0+ht),w.depthBuffer&&w.storeMultisampledDepthBuffer===!1&&Ee.push(ot),s.invalidateFramebuffer(s.READ_FRAMEBUFFER,Ee))}if(e.bindFramebuffer(s.READ_FRAMEBUFFER,null),e.bindFramebuffer(s.DRAW_FRAMEBUFFER,null),Y)for(let ht=0;ht<v.length;ht++){e.bindFramebuffer(s.FRAMEBUFFER,pt.__webglMultisampledFramebuffer),s.framebufferRenderbuffer(s.FRAMEBUFFER,s.COLOR_ATTACHMENT0+ht,s.RENDERBUFFER,pt.__webglColorRenderbuffer[ht]);let R=i.get(v[ht]).__webglTexture;e.bindFramebuffer(s.FRAMEBUFFER,pt.__webglFramebuffer),s.framebufferTexture2D(s.DRAW_FRAMEBUFFER,s.COLOR_ATTACHMENT0+ht,s.TEXTURE_2D,R,0)}e.bindFramebuffer(s.DRAW_FRAMEBUFFER,pt.__webglMultisampledFramebuffer)}else if(w.depthBuffer&&w.storeMultisampledDepthBuffer===!1&&l){let v=w.stencilBuffer?s.DEPTH_STENCIL_ATTACHMENT:s.DEPTH_ATTACHMENT;s.invalidateFramebuffer(s.DRAW_FRAMEBUFFER,[v])}}}function he(w){return Math.min(n.maxSamples,w.samples)}function ft(w){let v=i.get(w);return w.samples>0&&t.has("WEBGL_multisampled_render_to_texture")===!0&&v.__useRenderToTexture!==!1}function ve(w){let v=o.render.frame;h.get(w)!==v&&(h.set(w,v),w.update())}function Ut(w,v){let k=w.colorSpace,it=w.format,j=w.type;return w.isCompressedTexture===!0||w.isVideoTexture===!0||k!==br&&k!==an&&(ne.getTransfer(k)===le?(it!==Ci||j!==ii)&&kt("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):Bt("WebGLTextures: Unsupported texture color space:",k)),v}function zt(w){return typeof HTMLImageElement<"u"&&w instanceof HTMLImageElement?(c.width=w.naturalWidth||w.width,c.height=w.naturalHeight||w.height):typeof VideoFrame<"u"&&w instanceof VideoFrame?(c.width=w.displayWidth,c.height=w.displayHeight):(c.width=w.width,c.height=w.height),c}this.allocateTextureUnit=Ot,this.resetTextureUnits=K,this.getTextureUnits=tt,this.setTextureUnits=St,this.setTexture2D=xt,this.setTexture2DArray=wt,this.setTexture3D=Nt,this.setTextureCube=_t,this.rebindTextures=te,this.setupRenderTarget=oe,this.updateRenderTargetMipmap=N,this.updateMultisampleRenderTarget=Jt,this.setupDepthRenderbuffer=Kt,this.setupFrameBufferTexture=gt,this.useMultisampledRTT=ft,this.dispose=z}function TM(s,t){function e(i,n=an){let r,o=ne.getTransfer(n);if(i===ii)return s.UNSIGNED_BYTE;if(i===yl)return s.UNSIGNED_SHORT_4_4_4_4;if(i===bl)return s.UNSIGNED_SHORT_5_5_5_1;if(i===hu)return s.UNSIGNED_INT_5_9_9_9_REV;if(i===uu)return s.UNSIGNED_INT_10F_11F_11F_REV;if(i===lu)return s.BYTE;if(i===cu)return s.SHORT;if(i===zs)return s.UNSIGNED_SHORT;if(i===vl)return s.INT;if(i===Ti)return s.UNSIGNED_INT;if(i===xi)return s.FLOAT;if(i===Ri)return s.HALF_FLOAT;if(i===du)return s.ALPHA;if(i===fu)return s.RGB;if(i===Ci)return s.RGBA;if(i===en)return s.DEPTH_COMPONENT;if(i===on)return s.DEPTH_STENCIL;if(i===Ml)return s.RED;if(i===Sl)return s.RED_INTEGER;if(i===Cn)return s.RG;if(i===wl)return s.RG_INTEGER;if(i===El)return s.RGBA_INTEGER;if(i===ro||i===oo||i===ao||i===lo)if(o===le)if(r=t.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(i===ro)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(i===oo)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(i===ao)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(i===lo)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=t.get("WEBGL_compressed_texture_s3tc"),r!==null){if(i===ro)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(i===oo)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(i===ao)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(i===lo)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(i===Al||i===Tl||i===Rl||i===Cl)if(r=t.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(i===Al)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(i===Tl)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(i===Rl)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(i===Cl)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(i===Il||i===Pl||i===Ll||i===Nl||i===Dl||i===co||i===Ul)if(r=t.get("WEBGL_compressed_texture_etc"),r!==null){if(i===Il||i===Pl)return o===le?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(i===Ll)return o===le?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(i===Nl)return r.COMPRESSED_R11_EAC;if(i===Dl)return r.COMPRESSED_SIGNED_R11_EAC;if(i===co)return r.COMPRESSED_RG11_EAC;if(i===Ul)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(i===Ol||i===Fl||i===kl||i===Bl||i===zl||i===Gl||i===Vl||i===Hl||i===Wl||i===Xl||i===ql||i===$l||i===Yl||i===Zl)if(r=t.get("WEBGL_compressed_texture_astc"),r!==null){if(i===Ol)return o===le?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(i===Fl)return o===le?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(i===kl)return o===le?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(i===Bl)return o===le?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(i===zl)return o===le?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(i===Gl)return o===le?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(i===Vl)return o===le?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(i===Hl)return o===le?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(i===Wl)return o===le?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(i===Xl)return o===le?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(i===ql)return o===le?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(i===$l)return o===le?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(i===Yl)return o===le?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(i===Zl)return o===le?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(i===Jl||i===jl||i===Kl)if(r=t.get("EXT_texture_compression_bptc"),r!==null){if(i===Jl)return o===le?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(i===jl)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(i===Kl)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(i===Ql||i===tc||i===ho||i===ec)if(r=t.get("EXT_texture_compression_rgtc"),r!==null){if(i===Ql)return r.COMPRESSED_RED_RGTC1_EXT;if(i===tc)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(i===ho)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(i===ec)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return i===ts?s.UNSIGNED_INT_24_8:s[i]!==void 0?s[i]:null}return{convert:e}}var RM=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,CM=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,Fu=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(t,e){if(this.texture===null){let i=new Ur(t.texture);(t.depthNear!==e.depthNear||t.depthFar!==e.depthFar)&&(this.depthNear=t.depthNear,this.depthFar=t.depthFar),this.texture=i}}getMesh(t){if(this.texture!==null&&this.mesh===null){let e=t.cameras[0].viewport,i=new Me({vertexShader:RM,fragmentShader:CM,uniforms:{depthColor:{value:this.texture},depthWidth:{value:e.z},depthHeight:{value:e.w}}});this.mesh=new Wt(new Mn(20,20),i)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},ku=class extends Oi{constructor(t,e){super();let i=this,n=null,r=1,o=null,a="local-floor",l=1,c=null,h=null,u=null,d=null,f=null,p=null,_=typeof XRWebGLBinding<"u",m=new Fu,g={},b=e.getContextAttributes(),E=null,M=null,T=[],A=[],x=new lt,S=null,U=null,I=new Oe;I.viewport=new fe;let D=new Oe;D.viewport=new fe;let F=[I,D],H=new fl,C=null,z=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function($){let xt=T[$];return xt===void 0&&(xt=new Ts,T[$]=xt),xt.getTargetRaySpace()},this.getControllerGrip=function($){let xt=T[$];return xt===void 0&&(xt=new Ts,T[$]=xt),xt.getGripSpace()},this.getHand=function($){let xt=T[$];return xt===void 0&&(xt=new Ts,T[$]=xt),xt.getHandSpace()};function X($){let xt=A.indexOf($.inputSource);if(xt===-1)return;let wt=T[xt];wt!==void 0&&(wt.update($.inputSource,$.frame,c||o),wt.dispatchEvent({type:$.type,data:$.inputSource}))}function G(){n.removeEventListener("select",X),n.removeEventListener("selectstart",X),n.removeEventListener("selectend",X),n.removeEventListener("squeeze",X),n.removeEventListener("squeezestart",X),n.removeEventListener("squeezeend",X),n.removeEventListener("end",G),n.removeEventListener("inputsourceschange",et);for(let $=0;$<T.length;$++){let xt=A[$];xt!==null&&(A[$]=null,T[$].disconnect(xt))}C=null,z=null,m.reset();for(let $ in g)delete g[$];if(t.setRenderTarget(E),f=null,d=null,u=null,n=null,M=null,Ot.stop(),i.isPresenting=!1,t.setPixelRatio(S),t.setSize(x.width,x.height,!1),U!==null){let $=U.camera;$.fov=U.fov,$.zoom=U.zoom,$.updateProjectionMatrix(),U=null}i.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function($){r=$,i.isPresenting===!0&&kt("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function($){a=$,i.isPresenting===!0&&kt("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||o},this.setReferenceSpace=function($){c=$},this.getBaseLayer=function(){return d!==null?d:f},this.getBinding=function(){return u===null&&_&&(u=new XRWebGLBinding(n,e)),u},this.getFrame=function(){return p},this.getSession=function(){return n},this.setSession=async function($){if(n=$,n!==null){if(E=t.getRenderTarget(),n.addEventListener("select",X),n.addEventListener("selectstart",X),n.addEventListener("selectend",X),n.addEventListener("squeeze",X),n.addEventListener("squeezestart",X),n.addEventListener("squeezeend",X),n.addEventListener("end",G),n.addEventListener("inputsourceschange",et),b.xrCompatible!==!0&&await e.makeXRCompatible(),S=t.getPixelRatio(),t.getSize(x),_&&"createProjectionLayer"in XRWebGLBinding.prototype){let wt=null,Nt=null,_t=null;b.depth&&(_t=b.stencil?e.DEPTH24_STENCIL8:e.DEPTH_COMPONENT24,wt=b.stencil?on:en,Nt=b.stencil?ts:Ti);let Dt={colorFormat:e.RGBA8,depthFormat:_t,scaleFactor:r};u=this.getBinding(),d=u.createProjectionLayer(Dt),n.updateRenderState({layers:[d]}),t.setPixelRatio(1),t.setSize(d.textureWidth,d.textureHeight,!1),M=new li(d.textureWidth,d.textureHeight,{format:Ci,type:ii,depthTexture:new nn(d.textureWidth,d.textureHeight,Nt,void 0,void 0,void 0,void 0,void 0,void 0,wt),stencilBuffer:b.stencil,colorSpace:t.outputColorSpace,samples:b.antialias?4:0,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}else{let wt={antialias:b.antialias,alpha:!0,depth:b.depth,stencil:b.stencil,framebufferScaleFactor:r};f=new XRWebGLLayer(n,e,wt),n.updateRenderState({baseLayer:f}),t.setPixelRatio(1),t.setSize(f.framebufferWidth,f.framebufferHeight,!1),M=new li(f.framebufferWidth,f.framebufferHeight,{format:Ci,type:ii,colorSpace:t.outputColorSpace,stencilBuffer:b.stencil,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}M.isXRRenderTarget=!0,this.setFoveation(l),c=null,o=await n.requestReferenceSpace(a),Ot.setContext(n),Ot.start(),i.isPresenting=!0,i.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(n!==null)return n.environmentBlendMode},this.getDepthTexture=function(){return m.getDepthTexture()};function et($){for(let xt=0;xt<$.removed.length;xt++){let wt=$.removed[xt],Nt=A.indexOf(wt);Nt>=0&&(A[Nt]=null,T[Nt].disconnect(wt))}for(let xt=0;xt<$.added.length;xt++){let wt=$.added[xt],Nt=A.indexOf(wt);if(Nt===-1){for(let Dt=0;Dt<T.length;Dt++)if(Dt>=A.length){A.push(wt),Nt=Dt;break}else if(A[Dt]===null){A[Dt]=wt,Nt=Dt;break}if(Nt===-1)break}let _t=T[Nt];_t&&_t.connect(wt)}}function W($,xt){xt===null?$.matrixWorld.copy($.matrix):$.matrixWorld.multiplyMatrices(xt.matrixWorld,$.matrix),$.matrixWorldInverse.copy($.matrixWorld).invert()}this.updateCamera=function($){if(n===null)return;let xt=$.near,wt=$.far;m.texture!==null&&(m.depthNear>0&&(xt=m.depthNear),m.depthFar>0&&(wt=m.depthFar)),H.near=D.near=I.near=xt,H.far=D.far=I.far=wt,(C!==H.near||z!==H.far)&&(n.updateRenderState({depthNear:H.near,depthFar:H.far}),C=H.near,z=H.far),H.layers.mask=$.layers.mask|6,I.layers.mask=H.layers.mask&-5,D.layers.mask=H.layers.mask&-3;let Nt=$.parent,_t=H.cameras;W(H,Nt);for(let Dt=0;Dt<_t.length;Dt++)W(_t[Dt],Nt);H.projectionMatrix.copy(I.projectionMatrix),H.projectionMatrixInverse.copy(I.projectionMatrixInverse),U===null&&$.isPerspectiveCamera&&(U={camera:$,fov:$.fov,zoom:$.zoom}),K($,H,Nt)};function K($,xt,wt){wt===null?$.matrix.copy(xt.matrixWorld):($.matrix.copy(wt.matrixWorld),$.matrix.invert(),$.matrix.multiply(xt.matrixWorld)),$.matrix.decompose($.position,$.quaternion,$.scale),$.updateMatrixWorld(!0),$.projectionMatrix.copy(xt.projectionMatrix),$.projectionMatrixInverse.copy(xt.projectionMatrixInverse),$.isPerspectiveCamera&&($.fov=Ba*2*Math.atan(1/$.projectionMatrix.elements[5]),$.zoom=1)}this.getCamera=function(){return H},this.getFoveation=function(){if(!(d===null&&f===null))return l},this.setFoveation=function($){l=$,d!==null&&(d.fixedFoveation=$),f!==null&&f.fixedFoveation!==void 0&&(f.fixedFoveation=$)},this.hasDepthSensing=function(){return m.texture!==null},this.getDepthSensingMesh=function(){return m.getMesh(H)},this.getCameraTexture=function($){return g[$]};let tt=null;function St($,xt){if(h=xt.getViewerPose(c||o),p=xt,h!==null){let wt=h.views;f!==null&&(t.setRenderTargetFramebuffer(M,f.framebuffer),t.setRenderTarget(M));let Nt=!1;wt.length!==H.cameras.length&&(H.cameras.length=0,Nt=!0);for(let Ft=0;Ft<wt.length;Ft++){let Zt=wt[Ft],jt=null;if(f!==null)jt=f.getViewport(Zt);else{let ct=u.getViewSubImage(d,Zt);jt=ct.viewport,Ft===0&&(t.setRenderTargetTextures(M,ct.colorTexture,ct.depthStencilTexture),t.setRenderTarget(M))}let Q=F[Ft];Q===void 0&&(Q=new Oe,Q.layers.enable(Ft),Q.viewport=new fe,F[Ft]=Q),Q.matrix.fromArray(Zt.transform.matrix),Q.matrix.decompose(Q.position,Q.quaternion,Q.scale),Q.projectionMatrix.fromArray(Zt.projectionMatrix),Q.projectionMatrixInverse.copy(Q.projectionMatrix).invert(),Q.viewport.set(jt.x,jt.y,jt.width,jt.height),Ft===0&&(H.matrix.copy(Q.matrix),H.matrix.decompose(H.position,H.quaternion,H.scale)),Nt===!0&&H.cameras.push(Q)}let _t=n.enabledFeatures;if(_t&&_t.includes("depth-sensing")&&n.depthUsage=="gpu-optimized"&&_){u=i.getBinding();let Ft=u.getDepthInformation(wt[0]);Ft&&Ft.isValid&&Ft.texture&&m.init(Ft,n.renderState)}if(_t&&_t.includes("camera-access")&&_){t.state.unbindTexture(),u=i.getBinding();for(let Ft=0;Ft<wt.length;Ft++){let Zt=wt[Ft].camera;if(Zt){let jt=g[Zt];jt||(jt=new Ur,g[Zt]=jt);let Q=u.getCameraImage(Zt);jt.sourceTexture=Q}}}}for(let wt=0;wt<T.length;wt++){let Nt=A[wt],_t=T[wt];Nt!==null&&_t!==void 0&&_t.update(Nt,xt,c||o)}tt&&tt($,xt),xt.detectedPlanes&&i.dispatchEvent({type:"planesdetected",data:xt}),p=null}let Ot=new lm;Ot.setAnimationLoop(St),this.setAnimationLoop=function($){tt=$},this.dispose=function(){}}},IM=new re,_m=new Gt;_m.set(-1,0,0,0,1,0,0,0,1);function PM(s,t){function e(m,g){m.matrixAutoUpdate===!0&&m.updateMatrix(),g.value.copy(m.matrix)}function i(m,g){g.color.getRGB(m.fogColor.value,yu(s)),g.isFog?(m.fogNear.value=g.near,m.fogFar.value=g.far):g.isFogExp2&&(m.fogDensity.value=g.density)}function n(m,g,b,E,M){g.isNodeMaterial?g.uniformsNeedUpdate=!1:g.isMeshBasicMaterial?r(m,g):g.isMeshLambertMaterial?(r(m,g),g.envMap&&(m.envMapIntensity.value=g.envMapIntensity)):g.isMeshToonMaterial?(r(m,g),u(m,g)):g.isMeshPhongMaterial?(r(m,g),h(m,g),g.envMap&&(m.envMapIntensity.value=g.envMapIntensity)):g.isMeshStandardMaterial?(r(m,g),d(m,g),g.isMeshPhysicalMaterial&&f(m,g,M)):g.isMeshMatcapMaterial?(r(m,g),p(m,g)):g.isMeshDepthMaterial?r(m,g):g.isMeshDistanceMaterial?(r(m,g),_(m,g)):g.isMeshNormalMaterial?r(m,g):g.isLineBasicMaterial?(o(m,g),g.isLineDashedMaterial&&a(m,g)):g.isPointsMaterial?l(m,g,b,E):g.isSpriteMaterial?c(m,g):g.isShadowMaterial?(m.color.value.copy(g.color),m.opacity.value=g.opacity):g.isShaderMaterial&&(g.uniformsNeedUpdate=!1)}function r(m,g){m.opacity.value=g.opacity,g.color&&m.diffuse.value.copy(g.color),g.emissive&&m.emissive.value.copy(g.emissive).multiplyScalar(g.emissiveIntensity),g.map&&(m.map.value=g.map,e(g.map,m.mapTransform)),g.alphaMap&&(m.alphaMap.value=g.alphaMap,e(g.alphaMap,m.alphaMapTransform)),g.bumpMap&&(m.bumpMap.value=g.bumpMap,e(g.bumpMap,m.bumpMapTransform),m.bumpScale.value=g.bumpScale,g.side===ze&&(m.bumpScale.value*=-1)),g.normalMap&&(m.normalMap.value=g.normalMap,e(g.normalMap,m.normalMapTransform),m.normalScale.value.copy(g.normalScale),g.side===ze&&m.normalScale.value.negate()),g.displacementMap&&(m.displacementMap.value=g.displacementMap,e(g.displacementMap,m.displacementMapTransform),m.displacementScale.value=g.displacementScale,m.displacementBias.value=g.displacementBias),g.emissiveMap&&(m.emissiveMap.value=g.emissiveMap,e(g.emissiveMap,m.emissiveMapTransform)),g.specularMap&&(m.specularMap.value=g.specularMap,e(g.specularMap,m.specularMapTransform)),g.alphaTest>0&&(m.alphaTest.value=g.alphaTest);let b=t.get(g),E=b.envMap,M=b.envMapRotation;E&&(m.envMap.value=E,m.envMapRotation.value.setFromMatrix4(IM.makeRotationFromEuler(M)).transpose(),E.isCubeTexture&&E.isRenderTargetTexture===!1&&m.envMapRotation.value.premultiply(_m),m.reflectivity.value=g.reflectivity,m.ior.value=g.ior,m.refractionRatio.value=g.refractionRatio),g.lightMap&&(m.lightMap.value=g.lightMap,m.lightMapIntensity.value=g.lightMapIntensity,e(g.lightMap,m.lightMapTransform)),g.aoMap&&(m.aoMap.value=g.aoMap,m.aoMapIntensity.value=g.aoMapIntensity,e(g.aoMap,m.aoMapTransform))}function o(m,g){m.diffuse.value.copy(g.color),m.opacity.value=g.opacity,g.map&&(m.map.value=g.map,e(g.map,m.mapTransform))}function a(m,g){m.dashSize.value=g.dashSize,m.totalSize.value=g.dashSize+g.gapSize,m.scale.value=g.scale}function l(m,g,b,E){m.diffuse.value.copy(g.color),m.opacity.value=g.opacity,m.size.value=g.size*b,m.scale.value=E*.5,g.map&&(m.map.value=g.map,e(g.map,m.uvTransform)),g.alphaMap&&(m.alphaMap.value=g.alphaMap,e(g.alphaMap,m.alphaMapTransform)),g.alphaTest>0&&(m.alphaTest.value=g.alphaTest)}function c(m,g){m.diffuse.value.copy(g.color),m.opacity.value=g.opacity,m.rotation.value=g.rotation,g.map&&(m.map.value=g.map,e(g.map,m.mapTransform)),g.alphaMap&&(m.alphaMap.value=g.alphaMap,e(g.alphaMap,m.alphaMapTransform)),g.alphaTest>0&&(m.alphaTest.value=g.alphaTest)}function h(m,g){m.specular.value.copy(g.specular),m.shininess.value=Math.max(g.shininess,1e-4)}function u(m,g){g.gradientMap&&(m.gradientMap.value=g.gradientMap)}function d(m,g){m.metalness.value=g.metalness,g.metalnessMap&&(m.metalnessMap.value=g.metalnessMap,e(g.metalnessMap,m.metalnessMapTransform)),m.roughness.value=g.roughness,g.roughnessMap&&(m.roughnessMap.value=g.roughnessMap,e(g.roughnessMap,m.roughnessMapTransform)),g.envMap&&(m.envMapIntensity.value=g.envMapIntensity)}function f(m,g,b){m.ior.value=g.ior,g.diffuseRoughness>0&&(m.diffuseRoughness.value=g.diffuseRoughness,g.diffuseRoughnessMap&&(m.diffuseRoughnessMap.value=g.diffuseRoughnessMap,e(g.diffuseRoughnessMap,m.diffuseRoughnessMapTransform))),g.sheen>0&&(m.sheenColor.value.copy(g.sheenColor).multiplyScalar(g.sheen),m.sheenRoughness.value=g.sheenRoughness,g.sheenColorMap&&(m.sheenColorMap.value=g.sheenColorMap,e(g.sheenColorMap,m.sheenColorMapTransform)),g.sheenRoughnessMap&&(m.sheenRoughnessMap.value=g.sheenRoughnessMap,e(g.sheenRoughnessMap,m.sheenRoughnessMapTransform))),g.clearcoat>0&&(m.clearcoat.value=g.clearcoat,m.clearcoatRoughness.value=g.clearcoatRoughness,g.clearcoatMap&&(m.clearcoatMap.value=g.clearcoatMap,e(g.clearcoatMap,m.clearcoatMapTransform)),g.clearcoatRoughnessMap&&(m.clearcoatRoughnessMap.value=g.clearcoatRoughnessMap,e(g.clearcoatRoughnessMap,m.clearcoatRoughnessMapTransform)),g.clearcoatNormalMap&&(m.clearcoatNormalMap.value=g.clearcoatNormalMap,e(g.clearcoatNormalMap,m.clearcoatNormalMapTransform),m.clearcoatNormalScale.value.copy(g.clearcoatNormalScale),g.side===ze&&m.clearcoatNormalScale.value.negate())),g.dispersion>0&&(m.dispersion.value=g.dispersion),g.retroreflectivity>0&&(m.retroreflectivity.value=g.retroreflectivity),g.iridescence>0&&(m.iridescence.value=g.iridescence,m.iridescenceIOR.value=g.iridescenceIOR,m.iridescenceThicknessMinimum.value=g.iridescenceThicknessMinimum,m.iridescenceThicknessMaximum.value=g.iridescenceThicknessMaximum,g.iridescenceMap&&(m.iridescenceMap.value=g.iridescenceMap,e(g.iridescenceMap,m.iridescenceMapTransform)),g.iridescenceThicknessMap&&(m.iridescenceThicknessMap.value=g.iridescenceThicknessMap,e(g.iridescenceThicknessMap,m.iridescenceThicknessMapTransform))),g.transmission>0&&(m.transmission.value=g.transmission,m.transmissionSamplerMap.value=b.texture,m.transmissionSamplerSize.value.set(b.width,b.height),g.transmissionMap&&(m.transmissionMap.value=g.transmissionMap,e(g.transmissionMap,m.transmissionMapTransform)),m.thickness.value=g.thickness,g.thicknessMap&&(m.thicknessMap.value=g.thicknessMap,e(g.thicknessMap,m.thicknessMapTransform)),m.attenuationDistance.value=g.attenuationDistance,m.attenuationColor.value.copy(g.attenuationColor)),g.anisotropy>0&&(m.anisotropyVector.value.set(g.anisotropy*Math.cos(g.anisotropyRotation),g.anisotropy*Math.sin(g.anisotropyRotation)),g.anisotropyMap&&(m.anisotropyMap.value=g.anisotropyMap,e(g.anisotropyMap,m.anisotropyMapTransform))),m.specularIntensity.value=g.specularIntensity,m.specularColor.value.copy(g.specularColor),g.specularColorMap&&(m.specularColorMap.value=g.specularColorMap,e(g.specularColorMap,m.specularColorMapTransform)),g.specularIntensityMap&&(m.specularIntensityMap.value=g.specularIntensityMap,e(g.specularIntensityMap,m.specularIntensityMapTransform))}function p(m,g){g.matcap&&(m.matcap.value=g.matcap)}function _(m,g){let b=t.get(g).light;m.referencePosition.value.setFromMatrixPosition(b.matrixWorld),m.nearDistance.value=b.shadow.camera.near,m.farDistance.value=b.shadow.camera.far}return{refreshFogUniforms:i,refreshMaterialUniforms:n}}function LM(s,t,e,i){let n={},r={};function o(b,E){let M=E.program;i.uniformBlockBinding(b,M,n[b.id])}function a(b,E){let M=n[b.id];M===void 0&&(p(b),M=l(b),n[b.id]=M,b.addEventListener("dispose",m));let T=E.program;i.updateUBOMapping(b,T);let A=t.render.frame;r[b.id]!==A&&(c(b),r[b.id]=A)}function l(b){let E=s.createBuffer(),M=b.__size,T=b.usage;return s.bindBuffer(s.UNIFORM_BUFFER,E),s.bufferData(s.UNIFORM_BUFFER,M,T),s.bindBuffer(s.UNIFORM_BUFFER,null),E}function c(b){let E=n[b.id],M=b.uniforms,T=b.__cache;s.bindBuffer(s.UNIFORM_BUFFER,E);for(let A=0,x=M.length;A<x;A++){let S=M[A];if(Array.isArray(S))for(let U=0,I=S.length;U<I;U++)h(S[U],A,U,T);else h(S,A,0,T)}s.bindBuffer(s.UNIFORM_BUFFER,null)}function h(b,E,M,T){if(d(b,E,M,T)===!0){let A=b.__offset,x=b.value;if(Array.isArray(x)){let S=0;for(let U=0;U<x.length;U++){let I=x[U],D=_(I,!0);u(I,b.__data,S),S+=D.storage/Float32Array.BYTES_PER_ELEMENT}}else u(x,b.__data,0);s.bufferSubData(s.UNIFORM_BUFFER,A,b.__data)}}function u(b,E,M){typeof b=="number"||typeof b=="boolean"?E[M]=b:b.isMatrix3?(E[M]=b.elements[0],E[M+1]=b.elements[1],E[M+2]=b.elements[2],E[M+3]=0,E[M+4]=b.elements[3],E[M+5]=b.elements[4],E[M+6]=b.elements[5],E[M+7]=0,E[M+8]=b.elements[6],E[M+9]=b.elements[7],E[M+10]=b.elements[8],E[M+11]=0):ArrayBuffer.isView(b)?E.set(b.subarray(0,E.length-M),M):b.toArray(E,M)}function d(b,E,M,T){let A=b.value,x=E+"_"+M;if(Array.isArray(A)){T[x]===void 0&&(T[x]=[]);let S=T[x],U=!1;for(let I=0;I<A.length;I++)f(A[I],S,I)===!0&&(U=!0);return U}return f(A,T,x)}function f(b,E,M){if(E[M]===void 0)return typeof b=="number"||typeof b=="boolean"?E[M]=b:ArrayBuffer.isView(b)?E[M]=b.slice():E[M]=b.clone(),!0;{let T=E[M];if(typeof b=="number"||typeof b=="boolean"){if(T!==b)return E[M]=b,!0}else{if(ArrayBuffer.isView(b))return!0;if(T.equals(b)===!1)return T.copy(b),!0}}return!1}function p(b){let E=b.uniforms,M=0,T=16;for(let x=0,S=E.length;x<S;x++){let U=Array.isArray(E[x])?E[x]:[E[x]];for(let I=0,D=U.length;I<D;I++){let F=U[I],H=Array.isArray(F.value)?F.value:[F.value],C=Array.isArray(E[x])||Array.isArray(F.value),z=M;for(let G=0,et=H.length;G<et;G++){let W=H[G],K=_(W,C),tt=M%T,St=tt%K.boundary,Ot=tt+St;M+=St,Ot!==0&&T-Ot<K.storage&&(M+=T-Ot),G===0&&(z=M),M+=K.storage}let X=F.type==="int"?Int32Array:F.type==="uint"?Uint32Array:Float32Array;F.__data=new X((M-z)/Float32Array.BYTES_PER_ELEMENT),F.__offset=z}}let A=M%T;return A>0&&(M+=T-A),b.__size=M,b.__cache={},this}function _(b,E){let M={boundary:0,storage:0};return typeof b=="number"||typeof b=="boolean"?(M.boundary=4,M.storage=4):b.isVector2?(M.boundary=8,M.storage=8):b.isVector3||b.isColor?(M.boundary=16,M.storage=12):b.isVector4?(M.boundary=16,M.storage=16):b.isMatrix3?(M.boundary=16,M.storage=48):b.isMatrix4?(M.boundary=16,M.storage=64):b.isTexture?kt("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(b)?(M.boundary=16,M.storage=b.byteLength):kt("WebGLRenderer: Unsupported uniform value type.",b),E===!0&&(M.boundary=16,M.storage=Math.ceil(M.storage/16)*16),M}function m(b){let E=b.target;E.removeEventListener("dispose",m),s.deleteBuffer(n[E.id]),delete n[E.id],delete r[E.id]}function g(){for(let b in n)s.deleteBuffer(n[b]);n={},r={}}return{bind:o,update:a,dispose:g}}var NM=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),Vi=null;function DM(){return Vi===null&&(Vi=new Cr(NM,16,16,Cn,Ri),Vi.name="DFG_LUT",Vi.minFilter=Je,Vi.magFilter=Je,Vi.wrapS=Ui,Vi.wrapT=Ui,Vi.generateMipmaps=!1,Vi.needsUpdate=!0),Vi}var rc=class{constructor(t={}){let{canvas:e=Ap(),context:i=null,depth:n=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:u=!1,reversedDepthBuffer:d=!1,outputBufferType:f=ii}=t;this.isWebGLRenderer=!0;let p;if(i!==null){if(typeof WebGLRenderingContext<"u"&&i instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");p=i.getContextAttributes().alpha}else p=o;let _=f,m=new Set([El,wl,Sl]),g=new Set([ii,Ti,zs,ts,yl,bl]),b=new Uint32Array(4),E=new Int32Array(4),M={textures:[],min:[],max:[],resolution:[]},T=null,A=null,x=[],S=[],U=null;this.domElement=e,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=Gi,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let I=this,D=!1,F=null,H=null,C=null,z=null;this._outputColorSpace=Ze;let X=0,G=0,et=null,W=-1,K=null,tt=new fe,St=new fe,Ot=null,$=new Ct(0),xt=0,wt=e.width,Nt=e.height,_t=1,Dt=null,pe=null,Ft=new fe(0,0,wt,Nt),Zt=new fe(0,0,wt,Nt),jt=!1,Q=new bn,ct=new Ha,rt=!1,Mt=!1,gt=new re,Ht=new L,It=new fe,Kt={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},te=!1;function oe(){return et===null?_t:1}let N=i;function Ee(y,P){return e.getContext(y,P)}let Jt,he,ft,ve,Ut,zt,w,v,k,it,j,ot,pt,Y,Z,ht,R,J,q,ut,st,at,Pt;try{let y={alpha:!0,depth:n,stencil:r,antialias:a,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:h,failIfMajorPerformanceCaveat:u};if("setAttribute"in e&&e.setAttribute("data-engine",`three.js r${"187"}`),e.addEventListener("webglcontextlost",Lt,!1),e.addEventListener("webglcontextrestored",Xt,!1),e.addEventListener("webglcontextcreationerror",vt,!1),N===null){let P="webgl2";if(N=Ee(P,y),N===null)throw Ee(P)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}$t()}catch(y){throw e.removeEventListener("webglcontextlost",Lt,!1),e.removeEventListener("webglcontextrestored",Xt,!1),e.removeEventListener("webglcontextcreationerror",vt,!1),Bt("WebGLRenderer: "+y.message),y}function $t(){Jt=new Xy(N),Jt.init(),st=new TM(N,Jt),he=new Dy(N,Jt,t,st),ft=new EM(N,Jt),he.reversedDepthBuffer&&d&&ft.buffers.depth.setReversed(!0),H=N.createFramebuffer(),C=N.createFramebuffer(),z=N.createFramebuffer(),ve=new Yy(N),Ut=new uM,zt=new AM(N,Jt,ft,Ut,he,st,ve),w=new Wy(I),v=new Jx(N),at=new Ly(N,v),k=new qy(N,v,ve,at),it=new Jy(N,k,v,at,ve),J=new Zy(N,he,zt),Z=new Uy(Ut),j=new hM(I,w,Jt,he,at,Z),ot=new PM(I,Ut),pt=new fM,Y=new vM(Jt),R=new Py(I,w,ft,it,p,l),ht=new wM(I,it,he),Pt=new LM(N,ve,he,ft),q=new Ny(N,Jt,ve),ut=new $y(N,Jt,ve),ve.programs=j.programs,I.capabilities=he,I.extensions=Jt,I.properties=Ut,I.renderLists=pt,I.shadowMap=ht,I.state=ft,I.info=ve}_!==ii&&(U=new Ky(_,e.width,e.height,a,n,r));let nt=new ku(I,N);this.xr=nt,this.getContext=function(){return N},this.getContextAttributes=function(){return N.getContextAttributes()},this.forceContextLoss=function(){let y=Jt.get("WEBGL_lose_context");y&&y.loseContext()},this.forceContextRestore=function(){let y=Jt.get("WEBGL_lose_context");y&&y.restoreContext()},this.getPixelRatio=function(){return _t},this.setPixelRatio=function(y){y!==void 0&&(_t=y,this.setSize(wt,Nt,!1))},this.getSize=function(y){return y.set(wt,Nt)},this.setSize=function(y,P,V=!0){if(nt.isPresenting){kt("WebGLRenderer: Can't change size while VR device is presenting.");return}wt=y,Nt=P,e.width=Math.floor(y*_t),e.height=Math.floor(P*_t),V===!0&&(e.style.width=y+"px",e.style.height=P+"px"),U!==null&&U.setSize(e.width,e.height),this.setViewport(0,0,y,P)},this.getDrawingBufferSize=function(y){return y.set(wt*_t,Nt*_t).floor()},this.setDrawingBufferSize=function(y,P,V){wt=y,Nt=P,_t=V,e.width=Math.floor(y*V),e.height=Math.floor(P*V),this.setViewport(0,0,y,P)},this.setEffects=function(y){if(_===ii){Bt("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(y){for(let P=0;P<y.length;P++)if(y[P].isOutputPass===!0){kt("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}U.setEffects(y||[])},this.getCurrentViewport=function(y){return y.copy(tt)},this.getViewport=function(y){return y.copy(Ft)},this.setViewport=function(y,P,V,O){y.isVector4?Ft.set(y.x,y.y,y.z,y.w):Ft.set(y,P,V,O),ft.viewport(tt.copy(Ft).multiplyScalar(oe()).round())},this.getScissor=function(y){return y.copy(Zt)},this.setScissor=function(y,P,V,O){y.isVector4?Zt.set(y.x,y.y,y.z,y.w):Zt.set(y,P,V,O),ft.scissor(St.copy(Zt).multiplyScalar(oe()).round())},this.getScissorTest=function(){return jt},this.setScissorTest=function(y){ft.setScissorTest(jt=y)},this.setOpaqueSort=function(y){Dt=y},this.setTransparentSort=function(y){pe=y},this.getClearColor=function(y){return y.copy(R.getClearColor())},this.setClearColor=function(){R.setClearColor(...arguments)},this.getClearAlpha=function(){return R.getClearAlpha()},this.setClearAlpha=function(){R.setClearAlpha(...arguments)},this.clear=function(y=!0,P=!0,V=!0){let O=0;if(y){let B=!1;if(et!==null){let mt=et.texture.format;B=m.has(mt)}if(B){let mt=et.texture.type,Et=g.has(mt),dt=R.getClearColor(),bt=R.getClearAlpha(),Rt=dt.r,Vt=dt.g,ee=dt.b;Et?(b[0]=Rt,b[1]=Vt,b[2]=ee,b[3]=bt,N.clearBufferuiv(N.COLOR,0,b)):(E[0]=Rt,E[1]=Vt,E[2]=ee,E[3]=bt,N.clearBufferiv(N.COLOR,0,E))}else O|=N.COLOR_BUFFER_BIT}P&&(O|=N.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),V&&(O|=N.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),O!==0&&N.clear(O)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(y){y.setRenderer(this),F=y},this.dispose=function(){e.removeEventListener("webglcontextlost",Lt,!1),e.removeEventListener("webglcontextrestored",Xt,!1),e.removeEventListener("webglcontextcreationerror",vt,!1),R.dispose(),pt.dispose(),Y.dispose(),zt.dispose(),Ut.dispose(),w.dispose(),it.dispose(),k.dispose(),at.dispose(),Pt.dispose(),j.dispose(),nt.dispose(),nt.removeEventListener("sessionstart",Yu),nt.removeEventListener("sessionend",Zu),Nn.stop()};function Lt(y){y.preventDefault(),wr("WebGLRenderer: Context Lost."),D=!0}function Xt(){wr("WebGLRenderer: Context Restored."),D=!1;let y=ve.autoReset,P=ht.enabled,V=ht.autoUpdate,O=ht.needsUpdate,B=ht.type;$t(),ve.autoReset=y,ht.enabled=P,ht.autoUpdate=V,ht.needsUpdate=O,ht.type=B}function vt(y){Bt("WebGLRenderer: A WebGL context could not be created. Reason: ",y.statusMessage)}function ce(y){let P=y.target;P.removeEventListener("dispose",ce),Ne(P)}function Ne(y){cn(y),Ut.remove(y)}function cn(y){let P=Ut.get(y).programs;P!==void 0&&(P.forEach(function(V){j.releaseProgram(V)}),y.isShaderMaterial&&j.releaseShaderCache(y))}this.renderBufferDirect=function(y,P,V,O,B,mt){P===null&&(P=Kt);let Et=B.isMesh&&B.matrixWorld.determinantAffine()<0,dt=Hm(y,P,V,O,B);ft.setMaterial(O,Et);let bt=V.index,Rt=1;if(O.wireframe===!0){if(bt=k.getWireframeAttribute(V),bt===void 0)return;Rt=2}let Vt=V.drawRange,ee=V.attributes.position,At=Vt.start*Rt,ie=(Vt.start+Vt.count)*Rt;mt!==null&&(At=Math.max(At,mt.start*Rt),ie=Math.min(ie,(mt.start+mt.count)*Rt)),bt!==null?(At=Math.max(At,0),ie=Math.min(ie,bt.count)):ee!=null&&(At=Math.max(At,0),ie=Math.min(ie,ee.count));let Ae=ie-At;if(Ae<0||Ae===1/0)return;at.setup(B,O,dt,V,bt);let de,ue=q;if(bt!==null&&(de=v.get(bt),ue=ut,ue.setIndex(de)),B.isMesh)O.wireframe===!0?(ft.setLineWidth(O.wireframeLinewidth*oe()),ue.setMode(N.LINES)):ue.setMode(N.TRIANGLES);else if(B.isLine){let Ge=O.linewidth;Ge===void 0&&(Ge=1),ft.setLineWidth(Ge*oe()),B.isLineSegments?ue.setMode(N.LINES):B.isLineLoop?ue.setMode(N.LINE_LOOP):ue.setMode(N.LINE_STRIP)}else B.isPoints?ue.setMode(N.POINTS):B.isSprite&&ue.setMode(N.TRIANGLES);if(B.isBatchedMesh)if(Jt.get("WEBGL_multi_draw"))ue.renderMultiDraw(B._multiDrawStarts,B._multiDrawCounts,B._multiDrawCount);else{let Ge=B._multiDrawStarts,Tt=B._multiDrawCounts,qe=B._multiDrawCount,ae=bt?v.get(bt).bytesPerElement:1,Dn=Ut.get(O).currentProgram.getUniforms();for(let Ve=0;Ve<qe;Ve++)Dn.setValue(N,"_gl_DrawID",Ve),ue.render(Ge[Ve]/ae,Tt[Ve])}else if(B.isInstancedMesh)ue.renderInstances(At,Ae,B.count);else if(V.isInstancedBufferGeometry){let Ge=V._maxInstanceCount!==void 0?V._maxInstanceCount:1/0,Tt=Math.min(V.instanceCount,Ge);ue.renderInstances(At,Ae,Tt)}else ue.render(At,Ae)};function $u(y,P,V,O){F!==null&&y.isNodeMaterial&&F.setObject(O,y),rt===!0&&Z.setState(y,V,!1),y.transparent===!0&&y.side===Ie&&y.forceSinglePass===!1?(y.side=ze,y.needsUpdate=!0,Js(y,P,O),y.side=Rn,y.needsUpdate=!0,Js(y,P,O),y.side=Ie):Js(y,P,O)}this.compile=function(y,P,V=null){V===null&&(V=y),F!==null&&F.renderStart(y,P,V),A=Y.get(V),A.init(P),S.push(A),V.traverseVisible(function(B){B.isLight&&B.layers.test(P.layers)&&(A.pushLight(B),B.castShadow&&A.pushShadow(B))}),y!==V&&y.traverseVisible(function(B){B.isLight&&B.layers.test(P.layers)&&(A.pushLight(B),B.castShadow&&A.pushShadow(B))}),A.setupLights(),F!==null&&F.updateLights(A.state.lightsArray),Mt=this.localClippingEnabled,rt=Z.init(this.clippingPlanes,Mt),rt===!0&&Z.setGlobalState(this.clippingPlanes,P),F!==null&&ht.render(A.state.shadowsArray,V,P);let O=new Set;return y.traverse(function(B){if(!(B.isMesh||B.isPoints||B.isLine||B.isSprite))return;let mt=B.material;if(mt)if(Array.isArray(mt))for(let Et=0;Et<mt.length;Et++){let dt=mt[Et];$u(dt,V,P,B),O.add(dt)}else $u(mt,V,P,B),O.add(mt)}),A=S.pop(),F!==null&&F.renderEnd(),O},this.compileAsync=function(y,P,V=null){let O=this.compile(y,P,V);return new Promise(B=>{function mt(){if(O.forEach(function(Et){let bt=Ut.get(Et).currentProgram;(bt===void 0||bt.isReady())&&O.delete(Et)}),O.size===0){B(y);return}setTimeout(mt,10)}Jt.get("KHR_parallel_shader_compile")!==null?mt():setTimeout(mt,10)})};let Rc=null;function Gm(y){Rc&&Rc(y)}function Yu(){Nn.stop()}function Zu(){Nn.start()}let Nn=new lm;Nn.setAnimationLoop(Gm),typeof self<"u"&&Nn.setContext(self),this.setAnimationLoop=function(y){Rc=y,nt.setAnimationLoop(y),y===null?Nn.stop():Nn.start()},nt.addEventListener("sessionstart",Yu),nt.addEventListener("sessionend",Zu),this.render=function(y,P){if(P!==void 0&&P.isCamera!==!0){Bt("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(D===!0)return;F!==null&&F.renderStart(y,P);let V=nt.enabled===!0&&nt.isPresenting===!0,O=U!==null&&(et===null||V)&&U.begin(I,et);if(y.matrixWorldAutoUpdate===!0&&y.updateMatrixWorld(),P.parent===null&&P.matrixWorldAutoUpdate===!0&&P.updateMatrixWorld(),nt.enabled===!0&&nt.isPresenting===!0&&(U===null||U.isCompositing()===!1)&&(nt.cameraAutoUpdate===!0&&nt.updateCamera(P),P=nt.getCamera()),y.isScene===!0&&y.onBeforeRender(I,y,P,et),A=Y.get(y,S.length),A.init(P),A.state.textureUnits=zt.getTextureUnits(),S.push(A),gt.multiplyMatrices(P.projectionMatrix,P.matrixWorldInverse),P.isArrayCamera?ct.setFromArrayCamera(P):Q.setFromProjectionMatrix(gt,pi,P.reversedDepth),Mt=this.localClippingEnabled,rt=Z.init(this.clippingPlanes,Mt),T=pt.get(y,x.length),T.init(),x.push(T),this.info.render.frame++,nt.enabled===!0&&nt.isPresenting===!0){let Et=I.xr.getDepthSensingMesh();Et!==null&&Cc(Et,P,-1/0,I.sortObjects)}Cc(y,P,0,I.sortObjects),T.finish(),F!==null&&F.updateLights(A.state.lightsArray),I.sortObjects===!0&&T.sort(Dt,pe),te=nt.enabled===!1||nt.isPresenting===!1||nt.hasDepthSensing()===!1,te&&R.addToRenderList(T,y),this.info.autoReset===!0&&this.info.reset(),rt===!0&&Z.beginShadows();let B=A.state.shadowsArray;if(ht.render(B,y,P),rt===!0&&Z.endShadows(),(O&&U.hasRenderPass())===!1){let Et=T.opaque,dt=T.transmissive;if(A.setupLights(),P.isArrayCamera){let bt=P.cameras;if(dt.length>0)for(let Rt=0,Vt=bt.length;Rt<Vt;Rt++){let ee=bt[Rt];ju(Et,dt,y,ee)}te&&R.render(y);for(let Rt=0,Vt=bt.length;Rt<Vt;Rt++){let ee=bt[Rt];Ju(T,y,ee,ee.viewport)}}else dt.length>0&&ju(Et,dt,y,P),te&&R.render(y),Ju(T,y,P)}et!==null&&G===0&&(zt.updateMultisampleRenderTarget(et),zt.updateRenderTargetMipmap(et)),O&&U.end(I),y.isScene===!0&&y.onAfterRender(I,y,P),at.resetDefaultState(),W=-1,K=null,S.pop(),S.length>0?(A=S[S.length-1],zt.setTextureUnits(A.state.textureUnits),rt===!0&&Z.setGlobalState(I.clippingPlanes,A.state.camera)):A=null,x.pop(),x.length>0?T=x[x.length-1]:T=null,F!==null&&F.renderEnd()};function Cc(y,P,V,O){if(y.visible===!1)return;if(y.layers.test(P.layers)){if(y.isGroup)V=y.renderOrder;else if(y.isLOD)y.autoUpdate===!0&&y.update(P);else if(y.isLight)A.pushLight(y),y.castShadow&&A.pushShadow(y);else if(y.isSprite){let Et=P.isArrayCamera?ct:Q;if(!y.frustumCulled||y.intersectsFrustum(Et)){O&&It.setFromMatrixPosition(y.matrixWorld).applyMatrix4(gt);let dt=it.update(y),bt=y.material;bt.visible&&T.push(y,dt,bt,V,It.z,null,P)}}else if(y.isMesh||y.isLine||y.isPoints){let Et=P.isArrayCamera?ct:Q;if(!y.frustumCulled||y.intersectsFrustum(Et)){let dt=it.update(y),bt=y.material;if(O&&(y.boundingSphere!==void 0?(y.boundingSphere===null&&y.computeBoundingSphere(),It.copy(y.boundingSphere.center)):(dt.boundingSphere===null&&dt.computeBoundingSphere(),It.copy(dt.boundingSphere.center)),It.applyMatrix4(y.matrixWorld).applyMatrix4(gt)),Array.isArray(bt)){let Rt=dt.groups;for(let Vt=0,ee=Rt.length;Vt<ee;Vt++){let At=Rt[Vt],ie=bt[At.materialIndex];ie&&ie.visible&&T.push(y,dt,ie,V,It.z,At,P)}}else bt.visible&&T.push(y,dt,bt,V,It.z,null,P)}}}let mt=y.children;for(let Et=0,dt=mt.length;Et<dt;Et++)Cc(mt[Et],P,V,O)}function Ju(y,P,V,O){let{opaque:B,transmissive:mt,transparent:Et}=y;A.setupLightsView(V),rt===!0&&Z.setGlobalState(I.clippingPlanes,V),O&&ft.viewport(tt.copy(O)),B.length>0&&_o(B,P,V),mt.length>0&&_o(mt,P,V),Et.length>0&&_o(Et,P,V),ft.buffers.depth.setTest(!0),ft.buffers.depth.setMask(!0),ft.buffers.color.setMask(!0),ft.setPolygonOffset(!1)}function ju(y,P,V,O){if((V.isScene===!0?V.overrideMaterial:null)!==null)return;if(A.state.transmissionRenderTarget[O.id]===void 0){let At=Jt.has("EXT_color_buffer_half_float")||Jt.has("EXT_color_buffer_float");A.state.transmissionRenderTarget[O.id]=new li(1,1,{generateMipmaps:!0,type:At?Ri:ii,minFilter:rn,samples:Math.max(4,he.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:ne.workingColorSpace})}let mt=A.state.transmissionRenderTarget[O.id],Et=O.viewport||tt;mt.setSize(Et.z*I.transmissionResolutionScale,Et.w*I.transmissionResolutionScale);let dt=I.getRenderTarget(),bt=I.getActiveCubeFace(),Rt=I.getActiveMipmapLevel();I.setRenderTarget(mt),I.getClearColor($),xt=I.getClearAlpha(),xt<1&&I.setClearColor(16777215,.5),I.clear(),te&&R.render(V);let Vt=I.toneMapping;I.toneMapping=Gi;let ee=O.viewport;if(O.viewport!==void 0&&(O.viewport=void 0),A.setupLightsView(O),rt===!0&&Z.setGlobalState(I.clippingPlanes,O),_o(y,V,O),zt.updateMultisampleRenderTarget(mt),zt.updateRenderTargetMipmap(mt),Jt.has("WEBGL_multisampled_render_to_texture")===!1){let At=!1;for(let ie=0,Ae=P.length;ie<Ae;ie++){let de=P[ie],{object:ue,geometry:Ge,material:Tt,group:qe}=de;if(Tt.side===Ie&&ue.layers.test(O.layers)){let ae=Tt.side;Tt.side=ze,Tt.needsUpdate=!0,Ku(ue,V,O,Ge,Tt,qe),Tt.side=ae,Tt.needsUpdate=!0,At=!0}}At===!0&&(zt.updateMultisampleRenderTarget(mt),zt.updateRenderTargetMipmap(mt))}I.setRenderTarget(dt,bt,Rt),I.setClearColor($,xt),ee!==void 0&&(O.viewport=ee),I.toneMapping=Vt}function _o(y,P,V){let O=P.isScene===!0?P.overrideMaterial:null;for(let B=0,mt=y.length;B<mt;B++){let Et=y[B],{object:dt,geometry:bt,group:Rt}=Et,Vt=Et.material;Vt.allowOverride===!0&&O!==null&&(Vt=O),dt.layers.test(V.layers)&&Ku(dt,P,V,bt,Vt,Rt)}}function Ku(y,P,V,O,B,mt){F!==null&&B.isNodeMaterial&&F.setObject(y,B),y.onBeforeRender(I,P,V,O,B,mt),y.modelViewMatrix.multiplyMatrices(V.matrixWorldInverse,y.matrixWorld),y.normalMatrix.getNormalMatrix(y.modelViewMatrix),B.onBeforeRender(I,P,V,O,y,mt),B.transparent===!0&&B.side===Ie&&B.forceSinglePass===!1?(B.side=ze,B.needsUpdate=!0,I.renderBufferDirect(V,P,O,B,y,mt),B.side=Rn,B.needsUpdate=!0,I.renderBufferDirect(V,P,O,B,y,mt),B.side=Ie):I.renderBufferDirect(V,P,O,B,y,mt),y.onAfterRender(I,P,V,O,B,mt)}function Qu(y){let P=0;for(let V of y)V.texture!==null&&P++;return P}function Js(y,P,V){P.isScene!==!0&&(P=Kt);let O=Ut.get(y),B=A.state.lights,mt=A.state.shadowsArray,Et=B.state.version,dt=j.getParameters(y,B.state,mt,P,V,A.state.lightProbeGridArray),bt=j.getProgramCacheKey(dt),Rt=O.programs;O.environment=y.isMeshStandardMaterial||y.isMeshLambertMaterial||y.isMeshPhongMaterial?P.environment:null,O.fog=P.fog;let Vt=y.isMeshStandardMaterial||y.isMeshLambertMaterial&&!y.envMap||y.isMeshPhongMaterial&&!y.envMap;O.envMap=w.get(y.envMap||O.environment,Vt),O.envMapRotation=O.environment!==null&&y.envMap===null?P.environmentRotation:y.envMapRotation,Rt===void 0&&(y.addEventListener("dispose",ce),Rt=new Map,O.programs=Rt,O.programVariants=new Map);let ee=Rt.get(bt);if(ee!==void 0){if(O.currentProgram===ee&&O.lightsStateVersion===Et)return ed(y,dt),ee}else dt.uniforms=j.getUniforms(y),F!==null&&y.isNodeMaterial&&F.build(y,V,dt),y.onBeforeCompile(dt,I),ee=j.acquireProgram(dt,bt),Rt.set(bt,ee),O.uniforms=dt.uniforms;let At=O.uniforms;return(!y.isShaderMaterial&&!y.isRawShaderMaterial||y.clipping===!0)&&(At.clippingPlanes=Z.uniform),ed(y,dt),O.needsLights=Xm(y),O.lightsStateVersion=Et,O.needsLights&&(At.ambientLightColor.value=B.state.ambient,At.lightProbe.value=B.state.probe,At.sunLights.value=B.state.sun,At.sunLightShadows.value=B.state.sunShadow,At.directionalLights.value=B.state.directional,At.directionalLightShadows.value=B.state.directionalShadow,At.spotLights.value=B.state.spot,At.spotLightShadows.value=B.state.spotShadow,At.rectAreaLights.value=B.state.rectArea,At.ltc_1.value=B.state.rectAreaLTC1,At.ltc_2.value=B.state.rectAreaLTC2,At.pointLights.value=B.state.point,At.pointLightShadows.value=B.state.pointShadow,At.hemisphereLights.value=B.state.hemi,At.sunShadowMatrix.value=B.state.sunShadowMatrix,At.sunShadowCascade.value=B.state.sunShadowCascade,At.directionalShadowMatrix.value=B.state.directionalShadowMatrix,At.spotLightMatrix.value=B.state.spotLightMatrix,At.spotLightMap.value=B.state.spotLightMap,At.pointShadowMatrix.value=B.state.pointShadowMatrix),O.numLightProbeGrids=Qu(A.state.lightProbeGridArray),O.currentProgram=ee,O.uniformsList=null,ee}function Vm(y,P,V,O,B){let mt=Ut.get(y),Et=mt.currentProgram.id+","+O+","+B,dt=mt.programVariants.get(Et);return dt===void 0?(dt=Js(y,P,V),mt.programVariants.set(Et,dt)):(mt.currentProgram=dt,mt.uniformsList=null,mt.outputColorSpace=O,mt.toneMapping=B),dt}function td(y){if(y.uniformsList===null){let P=y.currentProgram.getUniforms();y.uniformsList=Gs.seqWithValue(P.seq,y.uniforms)}return y.uniformsList}function ed(y,P){let V=Ut.get(y);V.outputColorSpace=P.outputColorSpace,V.batching=P.batching,V.batchingColor=P.batchingColor,V.instancing=P.instancing,V.instancingColor=P.instancingColor,V.instancingMorph=P.instancingMorph,V.skinning=P.skinning,V.morphTargets=P.morphTargets,V.morphNormals=P.morphNormals,V.morphColors=P.morphColors,V.morphTargetsCount=P.morphTargetsCount,V.numClippingPlanes=P.numClippingPlanes,V.numIntersection=P.numClipIntersection,V.vertexAlphas=P.vertexAlphas,V.vertexTangents=P.vertexTangents,V.toneMapping=P.toneMapping}function Hm(y,P,V,O,B){P.isScene!==!0&&(P=Kt),zt.resetTextureUnits();let mt=P.fog,Et=O.isMeshStandardMaterial||O.isMeshLambertMaterial||O.isMeshPhongMaterial?P.environment:null,dt=et===null?I.outputColorSpace:et.isXRRenderTarget===!0?et.texture.colorSpace:ne.workingColorSpace,bt=O.isMeshStandardMaterial||O.isMeshLambertMaterial&&!O.envMap||O.isMeshPhongMaterial&&!O.envMap,Rt=w.get(O.envMap||Et,bt),Vt=O.vertexColors===!0&&!!V.attributes.color&&V.attributes.color.itemSize===4,ee=!!V.attributes.tangent&&(!!O.normalMap||O.anisotropy>0),At=!!V.morphAttributes.position,ie=!!V.morphAttributes.normal,Ae=!!V.morphAttributes.color,de=Gi;O.toneMapped&&(et===null||et.isXRRenderTarget===!0)&&(de=I.toneMapping);let ue=V.morphAttributes.position||V.morphAttributes.normal||V.morphAttributes.color,Ge=ue!==void 0?ue.length:0,Tt=Ut.get(O),qe=A.state.lights;if(rt===!0&&(Mt===!0||y!==K)){let ge=y===K&&O.id===W;Z.setState(O,y,ge)}let ae=!1,Dn=!1;O.version===Tt.__version?Tt.needsLights&&Tt.lightsStateVersion!==qe.state.version||B.isBatchedMesh&&Tt.batching===!1||!B.isBatchedMesh&&Tt.batching===!0||B.isBatchedMesh&&Tt.batchingColor===!0&&B._colorsTexture===null||B.isBatchedMesh&&Tt.batchingColor===!1&&B._colorsTexture!==null||B.isInstancedMesh&&Tt.instancing===!1||!B.isInstancedMesh&&Tt.instancing===!0||B.isSkinnedMesh&&Tt.skinning===!1||!B.isSkinnedMesh&&Tt.skinning===!0||B.isInstancedMesh&&Tt.instancingColor===!0&&B.instanceColor===null||B.isInstancedMesh&&Tt.instancingColor===!1&&B.instanceColor!==null||B.isInstancedMesh&&Tt.instancingMorph===!0&&B.morphTexture===null||B.isInstancedMesh&&Tt.instancingMorph===!1&&B.morphTexture!==null||Tt.envMap!==Rt||O.fog===!0&&Tt.fog!==mt||Tt.numClippingPlanes!==void 0&&(Tt.numClippingPlanes!==Z.numPlanes||Tt.numIntersection!==Z.numIntersection)||Tt.vertexAlphas!==Vt||Tt.vertexTangents!==ee||Tt.morphTargets!==At||Tt.morphNormals!==ie||Tt.morphColors!==Ae||Tt.morphTargetsCount!==Ge||Tt.numLightProbeGrids!==Qu(A.state.lightProbeGridArray)?ae=!0:(Tt.outputColorSpace!==dt||Tt.toneMapping!==de)&&(Dn=!0):(ae=!0,Tt.__version=O.version);let Ve=Tt.currentProgram;(ae===!0||Dn===!0)&&(Ve=Dn===!0?Vm(O,P,B,dt,de):Js(O,P,B),F&&O.isNodeMaterial&&F.onUpdateProgram(O,Ve,Tt));let vo=!1,hn=!1,Un=!1,se=Ve.getUniforms(),ke=Tt.uniforms;if(ft.useProgram(Ve.program)&&(vo=!0,hn=!0,Un=!0),O.id!==W&&(W=O.id,hn=!0),vo||K!==y){ft.buffers.depth.getReversed()&&y.reversedDepth!==!0&&(y._reversedDepth=!0,y.updateProjectionMatrix()),se.setValue(N,"projectionMatrix",y.projectionMatrix),se.setValue(N,"viewMatrix",y.matrixWorldInverse);let De=se.map.cameraPosition;De!==void 0&&De.setValue(N,Ht.setFromMatrixPosition(y.matrixWorld)),he.logarithmicDepthBuffer&&se.setValue(N,"logDepthBufFC",2/(Math.log(y.far+1)/Math.LN2)),(O.isMeshPhongMaterial||O.isMeshToonMaterial||O.isMeshLambertMaterial||O.isMeshBasicMaterial||O.isMeshStandardMaterial||O.isShaderMaterial)&&se.setValue(N,"isOrthographic",y.isOrthographicCamera===!0),K!==y&&(K=y,hn=!0,Un=!0)}if(Tt.needsLights&&(qe.state.sunShadowMap.length>0&&se.setValue(N,"sunShadowMap",qe.state.sunShadowMap,zt),qe.state.directionalShadowMap.length>0&&se.setValue(N,"directionalShadowMap",qe.state.directionalShadowMap,zt),qe.state.spotShadowMap.length>0&&se.setValue(N,"spotShadowMap",qe.state.spotShadowMap,zt),qe.state.pointShadowMap.length>0&&se.setValue(N,"pointShadowMap",qe.state.pointShadowMap,zt)),B.isSkinnedMesh){se.setOptional(N,B,"bindMatrix"),se.setOptional(N,B,"bindMatrixInverse");let ge=B.skeleton;ge&&(ge.boneTexture===null&&ge.computeBoneTexture(),se.setValue(N,"boneTexture",ge.boneTexture,zt))}B.isBatchedMesh&&(se.setOptional(N,B,"batchingTexture"),se.setValue(N,"batchingTexture",B._matricesTexture,zt),se.setOptional(N,B,"batchingIdTexture"),se.setValue(N,"batchingIdTexture",B._indirectTexture,zt),se.setOptional(N,B,"batchingColorTexture"),B._colorsTexture!==null&&se.setValue(N,"batchingColorTexture",B._colorsTexture,zt));let _i=V.morphAttributes;if((_i.position!==void 0||_i.normal!==void 0||_i.color!==void 0)&&J.update(B,V,Ve),(hn||Tt.receiveShadow!==B.receiveShadow)&&(Tt.receiveShadow=B.receiveShadow,se.setValue(N,"receiveShadow",B.receiveShadow)),(O.isMeshStandardMaterial||O.isMeshLambertMaterial||O.isMeshPhongMaterial)&&O.envMap===null&&P.environment!==null&&(ke.envMapIntensity.value=P.environmentIntensity),ke.dfgLUT!==void 0&&(ke.dfgLUT.value=DM()),hn){if(se.setValue(N,"toneMappingExposure",I.toneMappingExposure),Tt.needsLights&&Wm(ke,Un),mt&&O.fog===!0&&ot.refreshFogUniforms(ke,mt),ot.refreshMaterialUniforms(ke,O,_t,Nt,A.state.transmissionRenderTarget[y.id]),Tt.needsLights&&Tt.numLightProbeGrids>0){let ge=M,De=0;for(let Wi of A.state.lightProbeGridArray)Wi.texture!==null&&(ge.textures[De]=Wi.texture,ge.min[De]=Wi.boundingBox.min,ge.max[De]=Wi.boundingBox.max,ge.resolution[De]=Wi.resolution,De++);for(let Wi in ge)ge[Wi].length=De;ke.probesSH.value=ge.textures,ke.probesMin.value=ge.min,ke.probesMax.value=ge.max,ke.probesResolution.value=ge.resolution}Gs.upload(N,td(Tt),ke,zt)}if(O.isShaderMaterial&&O.uniformsNeedUpdate===!0&&(Gs.upload(N,td(Tt),ke,zt),O.uniformsNeedUpdate=!1),O.isSpriteMaterial&&se.setValue(N,"center",B.center),se.setValue(N,"modelViewMatrix",B.modelViewMatrix),se.setValue(N,"normalMatrix",B.normalMatrix),se.setValue(N,"modelMatrix",B.matrixWorld),O.uniformsGroups!==void 0){let ge=O.uniformsGroups;for(let De=0,Wi=ge.length;De<Wi;De++){let nd=ge[De];Pt.update(nd,Ve),Pt.bind(nd,Ve)}}return Ve}function Wm(y,P){y.ambientLightColor.needsUpdate=P,y.lightProbe.needsUpdate=P,y.sunLights.needsUpdate=P,y.sunLightShadows.needsUpdate=P,y.directionalLights.needsUpdate=P,y.directionalLightShadows.needsUpdate=P,y.pointLights.needsUpdate=P,y.pointLightShadows.needsUpdate=P,y.spotLights.needsUpdate=P,y.spotLightShadows.needsUpdate=P,y.rectAreaLights.needsUpdate=P,y.hemisphereLights.needsUpdate=P}function Xm(y){return y.isMeshLambertMaterial||y.isMeshToonMaterial||y.isMeshPhongMaterial||y.isMeshStandardMaterial||y.isShadowMaterial||y.isShaderMaterial&&y.lights===!0}this.getActiveCubeFace=function(){return X},this.getActiveMipmapLevel=function(){return G},this.getRenderTarget=function(){return et},this.setRenderTargetTextures=function(y,P,V){let O=Ut.get(y);O.__autoAllocateDepthBuffer=y.resolveDepthBuffer===!1,O.__autoAllocateDepthBuffer===!1&&(O.__useRenderToTexture=!1),Ut.get(y.texture).__webglTexture=P,Ut.get(y.depthTexture).__webglTexture=O.__autoAllocateDepthBuffer?void 0:V,O.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(y,P){let V=Ut.get(y);V.__webglFramebuffer=P,V.__useDefaultFramebuffer=P===void 0},this.setRenderTarget=function(y,P=0,V=0){et=y,X=P,G=V;let O=null,B=!1,mt=!1;if(y){let dt=Ut.get(y);if(dt.__useDefaultFramebuffer!==void 0){ft.bindFramebuffer(N.FRAMEBUFFER,dt.__webglFramebuffer),tt.copy(y.viewport),St.copy(y.scissor),Ot=y.scissorTest,ft.viewport(tt),ft.scissor(St),ft.setScissorTest(Ot),W=-1;return}else if(dt.__webglFramebuffer===void 0)zt.setupRenderTarget(y);else if(dt.__hasExternalTextures)zt.rebindTextures(y,Ut.get(y.texture).__webglTexture,Ut.get(y.depthTexture).__webglTexture);else if(y.depthBuffer){let Vt=y.depthTexture;if(dt.__boundDepthTexture!==Vt){if(Vt!==null&&Ut.has(Vt)&&(y.width!==Vt.image.width||y.height!==Vt.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");zt.setupDepthRenderbuffer(y)}}let bt=y.texture;(bt.isData3DTexture||bt.isDataArrayTexture||bt.isCompressedArrayTexture)&&(mt=!0);let Rt=Ut.get(y).__webglFramebuffer;y.isWebGLCubeRenderTarget?(Array.isArray(Rt[P])?O=Rt[P][V]:O=Rt[P],B=!0):y.samples>0&&zt.useMultisampledRTT(y)===!1?O=Ut.get(y).__webglMultisampledFramebuffer:Array.isArray(Rt)?O=Rt[V]:O=Rt,tt.copy(y.viewport),St.copy(y.scissor),Ot=y.scissorTest}else tt.copy(Ft).multiplyScalar(_t).floor(),St.copy(Zt).multiplyScalar(_t).floor(),Ot=jt;if(V!==0&&(O=H),ft.bindFramebuffer(N.FRAMEBUFFER,O)&&ft.drawBuffers(y,O),ft.viewport(tt),ft.scissor(St),ft.setScissorTest(Ot),B){let dt=Ut.get(y.texture);N.framebufferTexture2D(N.FRAMEBUFFER,N.COLOR_ATTACHMENT0,N.TEXTURE_CUBE_MAP_POSITIVE_X+P,dt.__webglTexture,V)}else if(mt){let dt=P;for(let bt=0;bt<y.textures.length;bt++){let Rt=Ut.get(y.textures[bt]);N.framebufferTextureLayer(N.FRAMEBUFFER,N.COLOR_ATTACHMENT0+bt,Rt.__webglTexture,V,dt)}}else if(y!==null&&V!==0){let dt=Ut.get(y.texture);N.framebufferTexture2D(N.FRAMEBUFFER,N.COLOR_ATTACHMENT0,N.TEXTURE_2D,dt.__webglTexture,V)}W=-1};function id(y){let P=Ut.get(y);return(P.__readFormat!==y.format||P.__readType!==y.type)&&(P.__readFormat=y.format,P.__readType=y.type,P.__formatReadable=he.textureFormatReadable(y.format),P.__typeReadable=he.textureTypeReadable(y.type)),P}this.readRenderTargetPixels=function(y,P,V,O,B,mt,Et,dt=0){if(!(y&&y.isWebGLRenderTarget)){Bt("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let bt=Ut.get(y).__webglFramebuffer;if(y.isWebGLCubeRenderTarget&&Et!==void 0&&(bt=bt[Et],Array.isArray(bt)&&(bt=bt[0])),bt){ft.bindFramebuffer(N.FRAMEBUFFER,bt);try{let Rt=y.textures[dt],Vt=Rt.format,ee=Rt.type;y.textures.length>1&&N.readBuffer(N.COLOR_ATTACHMENT0+dt);let At=id(Rt);if(At.__formatReadable===!1){Bt("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(At.__typeReadable===!1){Bt("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}P>=0&&P<=y.width-O&&V>=0&&V<=y.height-B&&N.readPixels(P,V,O,B,st.convert(Vt),st.convert(ee),mt)}finally{let Rt=et!==null?Ut.get(et).__webglFramebuffer:null;ft.bindFramebuffer(N.FRAMEBUFFER,Rt)}}},this.readRenderTargetPixelsAsync=async function(y,P,V,O,B,mt,Et,dt=0){if(!(y&&y.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let bt=Ut.get(y).__webglFramebuffer;if(y.isWebGLCubeRenderTarget&&Et!==void 0&&(bt=bt[Et],Array.isArray(bt)&&(bt=bt[0])),bt)if(P>=0&&P<=y.width-O&&V>=0&&V<=y.height-B){ft.bindFramebuffer(N.FRAMEBUFFER,bt);let Rt=y.textures[dt],Vt=Rt.format,ee=Rt.type;y.textures.length>1&&N.readBuffer(N.COLOR_ATTACHMENT0+dt);let At=id(Rt);if(At.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(At.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let ie=N.createBuffer();N.bindBuffer(N.PIXEL_PACK_BUFFER,ie),N.bufferData(N.PIXEL_PACK_BUFFER,mt.byteLength,N.STREAM_READ),N.readPixels(P,V,O,B,st.convert(Vt),st.convert(ee),0),N.bindBuffer(N.PIXEL_PACK_BUFFER,null);let Ae=et!==null?Ut.get(et).__webglFramebuffer:null;ft.bindFramebuffer(N.FRAMEBUFFER,Ae);let de=N.fenceSync(N.SYNC_GPU_COMMANDS_COMPLETE,0);return N.flush(),await Rp(N,de,4),N.bindBuffer(N.PIXEL_PACK_BUFFER,ie),N.getBufferSubData(N.PIXEL_PACK_BUFFER,0,mt),N.bindBuffer(N.PIXEL_PACK_BUFFER,null),N.deleteBuffer(ie),N.deleteSync(de),mt}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(y,P=null,V=0){let O=Math.pow(2,-V),B=Math.floor(y.image.width*O),mt=Math.floor(y.image.height*O),Et=P!==null?P.x:0,dt=P!==null?P.y:0;zt.setTexture2D(y,0),N.copyTexSubImage2D(N.TEXTURE_2D,V,0,0,Et,dt,B,mt),ft.unbindTexture()},this.copyTextureToTexture=function(y,P,V=null,O=null,B=0,mt=0){let Et,dt,bt,Rt,Vt,ee,At,ie,Ae,de=y.isCompressedTexture?y.mipmaps[mt]:y.image;if(V!==null)Et=V.max.x-V.min.x,dt=V.max.y-V.min.y,bt=V.isBox3?V.max.z-V.min.z:1,Rt=V.min.x,Vt=V.min.y,ee=V.isBox3?V.min.z:0;else{let se=Math.pow(2,-B);Et=Math.floor(de.width*se),dt=Math.floor(de.height*se),y.isDataArrayTexture?bt=de.depth:y.isData3DTexture?bt=Math.floor(de.depth*se):bt=1,Rt=0,Vt=0,ee=0}O!==null?(At=O.x,ie=O.y,Ae=O.z):(At=0,ie=0,Ae=0);let ue=st.convert(P.format),Ge=st.convert(P.type),Tt;P.isData3DTexture?(zt.setTexture3D(P,0),Tt=N.TEXTURE_3D):P.isDataArrayTexture||P.isCompressedArrayTexture?(zt.setTexture2DArray(P,0),Tt=N.TEXTURE_2D_ARRAY):(zt.setTexture2D(P,0),Tt=N.TEXTURE_2D),ft.activeTexture(N.TEXTURE0),ft.pixelStorei(N.UNPACK_FLIP_Y_WEBGL,P.flipY),ft.pixelStorei(N.UNPACK_PREMULTIPLY_ALPHA_WEBGL,P.premultiplyAlpha),ft.pixelStorei(N.UNPACK_ALIGNMENT,P.unpackAlignment);let qe=ft.getParameter(N.UNPACK_ROW_LENGTH),ae=ft.getParameter(N.UNPACK_IMAGE_HEIGHT),Dn=ft.getParameter(N.UNPACK_SKIP_PIXELS),Ve=ft.getParameter(N.UNPACK_SKIP_ROWS),vo=ft.getParameter(N.UNPACK_SKIP_IMAGES);ft.pixelStorei(N.UNPACK_ROW_LENGTH,de.width),ft.pixelStorei(N.UNPACK_IMAGE_HEIGHT,de.height),ft.pixelStorei(N.UNPACK_SKIP_PIXELS,Rt),ft.pixelStorei(N.UNPACK_SKIP_ROWS,Vt),ft.pixelStorei(N.UNPACK_SKIP_IMAGES,ee);let hn=y.isDataArrayTexture||y.isData3DTexture,Un=P.isDataArrayTexture||P.isData3DTexture;if(y.isDepthTexture){let se=Ut.get(y),ke=Ut.get(P),_i=Ut.get(se.__renderTarget),ge=Ut.get(ke.__renderTarget);ft.bindFramebuffer(N.READ_FRAMEBUFFER,_i.__webglFramebuffer),ft.bindFramebuffer(N.DRAW_FRAMEBUFFER,ge.__webglFramebuffer);for(let De=0;De<bt;De++)hn&&(N.framebufferTextureLayer(N.READ_FRAMEBUFFER,N.COLOR_ATTACHMENT0,Ut.get(y).__webglTexture,B,ee+De),N.framebufferTextureLayer(N.DRAW_FRAMEBUFFER,N.COLOR_ATTACHMENT0,Ut.get(P).__webglTexture,mt,Ae+De)),N.blitFramebuffer(Rt,Vt,Rt+Et,Vt+dt,At,ie,At+Et,ie+dt,N.DEPTH_BUFFER_BIT,N.NEAREST);ft.bindFramebuffer(N.READ_FRAMEBUFFER,null),ft.bindFramebuffer(N.DRAW_FRAMEBUFFER,null)}else if(B!==0||y.isRenderTargetTexture||Ut.has(y)){let se=Ut.get(y),ke=Ut.get(P);ft.bindFramebuffer(N.READ_FRAMEBUFFER,C),ft.bindFramebuffer(N.DRAW_FRAMEBUFFER,z);for(let _i=0;_i<bt;_i++)hn?N.framebufferTextureLayer(N.READ_FRAMEBUFFER,N.COLOR_ATTACHMENT0,se.__webglTexture,B,ee+_i):N.framebufferTexture2D(N.READ_FRAMEBUFFER,N.COLOR_ATTACHMENT0,N.TEXTURE_2D,se.__webglTexture,B),Un?N.framebufferTextureLayer(N.DRAW_FRAMEBUFFER,N.COLOR_ATTACHMENT0,ke.__webglTexture,mt,Ae+_i):N.framebufferTexture2D(N.DRAW_FRAMEBUFFER,N.COLOR_ATTACHMENT0,N.TEXTURE_2D,ke.__webglTexture,mt),B!==0?N.blitFramebuffer(Rt,Vt,Rt+Et,Vt+dt,At,ie,At+Et,ie+dt,N.COLOR_BUFFER_BIT,N.NEAREST):Un?N.copyTexSubImage3D(Tt,mt,At,ie,Ae+_i,Rt,Vt,Et,dt):N.copyTexSubImage2D(Tt,mt,At,ie,Rt,Vt,Et,dt);ft.bindFramebuffer(N.READ_FRAMEBUFFER,null),ft.bindFramebuffer(N.DRAW_FRAMEBUFFER,null)}else Un?y.isDataTexture||y.isData3DTexture?N.texSubImage3D(Tt,mt,At,ie,Ae,Et,dt,bt,ue,Ge,de.data):P.isCompressedArrayTexture?N.compressedTexSubImage3D(Tt,mt,At,ie,Ae,Et,dt,bt,ue,de.data):N.texSubImage3D(Tt,mt,At,ie,Ae,Et,dt,bt,ue,Ge,de):y.isDataTexture?N.texSubImage2D(N.TEXTURE_2D,mt,At,ie,Et,dt,ue,Ge,de.data):y.isCompressedTexture?N.compressedTexSubImage2D(N.TEXTURE_2D,mt,At,ie,de.width,de.height,ue,de.data):N.texSubImage2D(N.TEXTURE_2D,mt,At,ie,Et,dt,ue,Ge,de);ft.pixelStorei(N.UNPACK_ROW_LENGTH,qe),ft.pixelStorei(N.UNPACK_IMAGE_HEIGHT,ae),ft.pixelStorei(N.UNPACK_SKIP_PIXELS,Dn),ft.pixelStorei(N.UNPACK_SKIP_ROWS,Ve),ft.pixelStorei(N.UNPACK_SKIP_IMAGES,vo),mt===0&&P.generateMipmaps===!0&&P.mipmapsAutoUpdate===!0&&N.generateMipmap(Tt),ft.unbindTexture()},this.initRenderTarget=function(y){Ut.get(y).__webglFramebuffer===void 0&&zt.setupRenderTarget(y)},this.initTexture=function(y){y.isCubeTexture?zt.setTextureCube(y,0):y.isData3DTexture?zt.setTexture3D(y,0):y.isDataArrayTexture||y.isCompressedArrayTexture?zt.setTexture2DArray(y,0):zt.setTexture2D(y,0),ft.unbindTexture()},this.resetState=function(){X=0,G=0,et=null,ft.reset(),at.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return pi}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(t){this._outputColorSpace=t;let e=this.getContext();e.drawingBufferColorSpace=ne._getDrawingBufferColorSpace(t),e.unpackColorSpace=ne._getUnpackColorSpace()}};var lc=class extends qn{constructor(){super(),this.name="RoomEnvironment",this.position.y=-3.5;let t=new zi;t.deleteAttribute("uv");let e=new wn({side:ze}),i=new wn,n=new Qr(16777215,900,28,2);n.position.set(.418,16.199,.3),this.add(n);let r=new Wt(t,e);r.position.set(-.757,13.219,.717),r.scale.set(31.713,28.305,28.591),this.add(r);let o=new Ir(t,i,6),a=new Ce;a.position.set(-10.906,2.009,1.846),a.rotation.set(0,-.195,0),a.scale.set(2.328,7.905,4.651),a.updateMatrix(),o.setMatrixAt(0,a.matrix),a.position.set(-5.607,-.754,-.758),a.rotation.set(0,.994,0),a.scale.set(1.97,1.534,3.955),a.updateMatrix(),o.setMatrixAt(1,a.matrix),a.position.set(6.167,.857,7.803),a.rotation.set(0,.561,0),a.scale.set(3.927,6.285,3.687),a.updateMatrix(),o.setMatrixAt(2,a.matrix),a.position.set(-2.017,.018,6.124),a.rotation.set(0,.333,0),a.scale.set(2.002,4.566,2.064),a.updateMatrix(),o.setMatrixAt(3,a.matrix),a.position.set(2.291,-.756,-2.621),a.rotation.set(0,-.286,0),a.scale.set(1.546,1.552,1.496),a.updateMatrix(),o.setMatrixAt(4,a.matrix),a.position.set(-2.193,-.369,-5.547),a.rotation.set(0,.516,0),a.scale.set(3.875,3.487,2.986),a.updateMatrix(),o.setMatrixAt(5,a.matrix),this.add(o);let l=new Wt(t,Ws(50));l.position.set(-16.116,14.37,8.208),l.scale.set(.1,2.428,2.739),this.add(l);let c=new Wt(t,Ws(50));c.position.set(-16.109,18.021,-8.207),c.scale.set(.1,2.425,2.751),this.add(c);let h=new Wt(t,Ws(17));h.position.set(14.904,12.198,-1.832),h.scale.set(.15,4.265,6.331),this.add(h);let u=new Wt(t,Ws(43));u.position.set(-.462,8.89,14.52),u.scale.set(4.38,5.441,.088),this.add(u);let d=new Wt(t,Ws(20));d.position.set(3.235,11.486,-12.541),d.scale.set(2.5,2,.1),this.add(d);let f=new Wt(t,Ws(100));f.position.set(0,20,0),f.scale.set(1,.1,1),this.add(f)}dispose(){let t=new Set;this.traverse(e=>{e.isMesh&&(t.add(e.geometry),t.add(e.material))});for(let e of t)e.dispose()}};function Ws(s){return new Yr({color:0,emissive:16777215,emissiveIntensity:s})}var UM=`
attribute float clearance;
varying float room;
void main() {
  room = clearance;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`,OM=`
uniform vec3 color;
varying float room;
void main() {
  if (room > 0.0) discard;
  gl_FragColor = vec4(color, 0.3);
  #include <colorspace_fragment>
}`,cc=class extends Wt{constructor(){let t={transparent:!0,depthWrite:!1,side:Ie,uniforms:{color:{value:new Ct}}};super(new Sn(1,96,64),new Me({vertexShader:UM,fragmentShader:OM,...t})),this.visible=!1}get directions(){let{array:t,count:e}=this.geometry.attributes.position;return Array.from({length:e},(i,n)=>Array.from(t.subarray(3*n,3*n+3)))}take(t){this.geometry.setAttribute("clearance",new qt(t,1)),this.known=t.some(e=>e<=0)}place(t,e){let i=!!(t&&this.known),n=i!==this.visible;return this.visible=i,i&&this.position.set(...t),i&&this.scale.setScalar(e),n}colour(t){this.material.uniforms.color.value.set(t.failed)}};var vm=32,FM=2.7,ym=.35,Bu={share:.34,least:112,most:560},bm={right:14,top:112},Xs=1,hc=class{constructor(){this.top=bm.top*si(),this.camera=new Oe(vm,1),this.camera.matrixAutoUpdate=!1,this.camera.layers.set(Xs)}place(t,e){let i=Math.round(Math.min(Math.max(Bu.share*Math.min(t,e),Bu.least),Bu.most));return{left:t-bm.right-i,top:this.top,side:i}}aim(t,e){let i=e*FM*t.vehicle.body.hub_radius/Math.tan(vm*Math.PI/360),[n,r]=[Math.sin(ym),Math.cos(ym)],o=(...h)=>new L(...h).applyQuaternion(t.body.quaternion),a=o(-n,0,r),l=o(r,0,n),c=o(0,-1,0);return this.camera.matrix.makeBasis(c,l,a).setPosition(a.clone().multiplyScalar(i).add(t.position)),Object.assign(this.camera,{near:.05*i,far:20*i}),this.camera.updateProjectionMatrix(),this.camera.updateMatrixWorld(!0),a}};function Pn(s,t=!1){let e=s[0].index!==null,i=new Set(Object.keys(s[0].attributes)),n=new Set(Object.keys(s[0].morphAttributes)),r={},o={},a=s[0].morphTargetsRelative,l=new _e;l.morphTargetsRelative=a;let c=0;for(let h=0;h<s.length;++h){let u=s[h],d=0,f=0;if(e!==(u.index!==null))return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+". All geometries must have compatible attributes; make sure index attribute exists among all geometries, or in none of them."),null;for(let p in u.attributes){if(!i.has(p))return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+'. All geometries must have compatible attributes; make sure "'+p+'" attribute exists among all geometries, or in none of them.'),null;r[p]===void 0&&(r[p]=[]),r[p].push(u.attributes[p]),d++}if(d!==i.size)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+". Make sure all geometries have the same number of attributes."),null;if(a!==u.morphTargetsRelative)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+". .morphTargetsRelative must be consistent throughout all geometries."),null;for(let p in u.morphAttributes){if(!n.has(p))return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+".  .morphAttributes must be consistent throughout all geometries."),null;if(u.morphAttributes[p].length!==s[0].morphAttributes[p].length)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+'. All geometries must have the same number of morph targets for the "'+p+'" morph attribute.'),null;o[p]===void 0&&(o[p]=[]),o[p].push(u.morphAttributes[p]),f++}if(f!==n.size)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+". Make sure all geometries have the same number of morph attributes."),null;if(t){let p;if(e)p=u.index.count;else if(u.attributes.position!==void 0)p=u.attributes.position.count;else return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+". The geometry must have either an index or a position attribute"),null;l.addGroup(c,p,h),c+=p}}if(e){let h=0,u=[];for(let d=0;d<s.length;++d){let f=s[d].index;for(let p=0;p<f.count;++p)u.push(f.getX(p)+h);h+=s[d].attributes.position.count}l.setIndex(u)}for(let h in r){let u=Mm(r[h]);if(!u)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed while trying to merge the "+h+" attribute."),null;l.setAttribute(h,u)}for(let h in o){let u=o[h][0].length;if(u!==0){l.morphAttributes=l.morphAttributes||{},l.morphAttributes[h]=[];for(let d=0;d<u;++d){let f=[];for(let _=0;_<o[h].length;++_)f.push(o[h][_][d]);let p=Mm(f);if(!p)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed while trying to merge the "+h+" morphAttribute."),null;l.morphAttributes[h].push(p)}}}return l}function Mm(s){let t,e,i,n=-1,r=0;for(let c=0;c<s.length;++c){let h=s[c];if(t===void 0&&(t=h.array.constructor),t!==h.array.constructor)return console.error("THREE.BufferGeometryUtils: .mergeAttributes() failed. BufferAttribute.array must be of consistent array types across matching attributes."),null;if(e===void 0&&(e=h.itemSize),e!==h.itemSize)return console.error("THREE.BufferGeometryUtils: .mergeAttributes() failed. BufferAttribute.itemSize must be consistent across matching attributes."),null;if(i===void 0&&(i=h.normalized),i!==h.normalized)return console.error("THREE.BufferGeometryUtils: .mergeAttributes() failed. BufferAttribute.normalized must be consistent across matching attributes."),null;if(n===-1&&(n=h.gpuType),n!==h.gpuType)return console.error("THREE.BufferGeometryUtils: .mergeAttributes() failed. BufferAttribute.gpuType must be consistent across matching attributes."),null;r+=h.count*e}let o=new t(r),a=new ti(o,e,i),l=0;for(let c=0;c<s.length;++c){let h=s[c];if(h.isInterleavedBufferAttribute){let u=l/e;for(let d=0,f=h.count;d<f;d++)for(let p=0;p<e;p++){let _=h.getComponent(d,p);a.setComponent(d+u,p,_)}}else o.set(h.array,l);l+=h.count*e}return n!==void 0&&(a.gpuType=n),a}var kM=1.5,BM=3,zM=`
attribute float rotor;
uniform vec3 color[ROTORS];
uniform float angle[ROTORS], swept[ROTORS], way[ROTORS];
varying vec2 place;
varying vec3 tone;
varying float sweep, turn, which;
void main() {
  int k = int(rotor + 0.5);
  float c = cos(angle[k]), s = sin(angle[k]);
  place = mat2(c, -s, s, c) * (2.0 * uv - 1.0);
  tone = color[k];
  sweep = swept[k];
  turn = way[k];
  which = rotor;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`,GM=`
uniform vec3 alarm;
uniform float opacity, touched;
varying vec2 place;
varying vec3 tone;
varying float sweep, turn, which;
const float APART = 3.14159265; // rad between two blades
void main() {
  if (abs(which - touched) < 0.5) {
    gl_FragColor = vec4(alarm, 0.85);
    #include <colorspace_fragment>
    return;
  }
  float r = length(place), pixel = max(length(fwidth(place)), 1e-4);
  float chord = mix(0.1, 0.24, smoothstep(0.08, 0.32, r)) * (1.0 - 0.5 * smoothstep(0.3, 1.0, r));
  float blade = min(chord / max(r, 0.05), 0.9 * APART), edge = min(1.5 * pixel / max(r, 0.05), 0.5 * blade);
  float behind = mod(0.5 * blade - turn * atan(place.y, place.x), APART);
  float trail = clamp(1.0 - (behind - blade) / max(sweep, 1e-3), 0.0, 1.0);
  float sharp = smoothstep(0.0, edge, behind) * (1.0 - smoothstep(blade - edge, blade, behind));
  float over = clamp(1.0 - (behind + APART - blade) / max(sweep, 1e-3), 0.0, 1.0); // of the other blade
  float shown = sqrt(blade / (blade + 0.5 * sweep)) * max(mix(trail * step(blade - edge, behind), 1.0, sharp), over);
  float whole = sqrt(blade / APART); // of a rotor too fast to be seen turning
  float ink = mix(shown, whole, smoothstep(0.7 * APART, 1.6 * APART, sweep));
  gl_FragColor = vec4(tone, opacity * max(0.2, ink));
  #include <colorspace_fragment>
}`;function VM(s,t){let e=()=>new Float32Array(s);return new Me({vertexShader:zM,fragmentShader:GM,defines:{ROTORS:s},transparent:!0,depthWrite:!1,side:Ie,forceSinglePass:!0,uniforms:{color:{value:new Float32Array(3*s)},alarm:{value:new Ct},opacity:{value:t},angle:{value:e()},swept:{value:e()},way:{value:e()},touched:{value:-1}}})}function Sm(s,t,e){let i=(n,r,o,a)=>new je(n,r,o,20).rotateX(Math.PI/2).translate(e.x,e.y,e.z+a);return[i(.16*s,.19*s,t,-t/2),i(.05*s,.11*s,.12*s,.06*s)]}var uc=class extends be{constructor(t,e,i,n,r,o){super(),Object.assign(this,{spins:i,sides:n});let a=(c,{x:h,y:u,z:d})=>c.translate(h,u,d),l=e.map((c,h)=>{let u=a(new Or(t,48),c),d=new Array(u.attributes.position.count).fill(h);return u.setAttribute("rotor",new qt(d,1))});this.blades=VM(e.length,o?.35:.85),this.add(new Wt(Pn(l),this.blades));for(let c of new Set(n)){let h=e.filter((u,d)=>n[d]===c).map(u=>a(new qr(.965*t,t,64),u));this.add(new Wt(Pn(h),r[c]))}}show(t,e,i){let n=Ni(),{angle:r,swept:o,way:a}=this.blades.uniforms,l=Math.min(Math.sqrt(Math.abs(i)),BM);r.value[t]=n?0:-this.spins[t]*e,o.value[t]=n&&l>0?2*Math.PI:kM*l,a.value[t]=-this.spins[t]*(i<0?-1:1)}touch(t){this.blades.uniforms.touched.value=t}colour(t,e){this.sides.forEach((i,n)=>new Ct(t(i)).toArray(this.blades.uniforms.color.value,3*n)),this.blades.uniforms.alarm.value.set(e)}};var HM=new L(0,1,0),WM=new L(0,0,1),zu=.7,wm=1.1,XM=.32,Gu={room:1.08,most:.8,thick:.007},qM=.24,Em=2,$M={body:{roughness:.42,metalness:.25},rod:{roughness:.32,metalness:.08},front:{roughness:.5,metalness:0},rear:{roughness:.4,metalness:.3},thrust:{roughness:.6,metalness:0}},YM=["rod_length","rod_end","rotor_positions","rotor_spins","rotor_radius","mount","body"],ZM=`
varying vec3 normalSeen, seen;
void main() {
  vec4 view = modelViewMatrix * vec4(position, 1.0);
  normalSeen = normalMatrix * normal;
  seen = -view.xyz;
  gl_Position = projectionMatrix * view;
}`,JM=`
uniform vec3 color;
uniform float opacity;
varying vec3 normalSeen, seen;
void main() {
  float facing = abs(dot(normalize(normalSeen), normalize(seen)));
  gl_FragColor = vec4(color, opacity * mix(0.08, 1.0, 1.0 - smoothstep(0.35, 0.62, facing)));
  #include <colorspace_fragment>
}`;function jM(s){return new Me({vertexShader:ZM,fragmentShader:JM,transparent:!0,depthWrite:!1,uniforms:{color:{value:new Ct},opacity:{value:s}}})}function KM(s){return Object.fromEntries(["body","front","rear","rod","thrust"].map(e=>{let i=new wn({...$M[e],side:Ie});return s&&Object.assign(i,{transparent:!0,opacity:.38,depthWrite:!1,forceSinglePass:!0}),[e,i]}))}function Vu(s,t,e){let i=new Wt(s,t);return i.castShadow=!e,i}function QM(s,t,e,i=1){let n=t.clone().sub(s),r=new Wt(new je(i*e,e,n.length(),14));return r.quaternion.setFromUnitVectors(HM,n.clone().normalize()),r.position.copy(s).addScaledVector(n,.5),r}function tS(s){return s.updateMatrix(),s.geometry.applyMatrix4(s.matrix)}function eS(s){let t=(r,o)=>new je(o,o,.02*s,8).rotateX(Math.PI/2).rotateZ(Math.PI/8).translate(0,0,r),e=(r,o)=>new je(.014*s,.014*s,.14*s,8).rotateX(Math.PI/2).translate(r,o,.05*s),i=[[1,1],[-1,1],[-1,-1],[1,-1]].map(([r,o])=>e(.13*r*s,.13*o*s)),n=new zi(.4*s,.19*s,.14*s).translate(0,0,-.1*s);return[t(-.02*s,.26*s),t(.12*s,.2*s),n,...i]}var Am=s=>[new je(.5,.5,1,24,1,s),new Fr(s?1:1.5,1,32,1,s)],dc=class extends be{constructor(t,[e,i],n,r=4.5){super(),Object.assign(this,{width:t,heads:r,shaft:new Wt(e,n),head:new Wt(i,n)}),this.add(this.shaft,this.head);for(let o of[this.shaft,this.head])o.rotation.x=Math.PI/2}stretch(t){let e=Math.abs(t),i=Math.min(this.heads*this.width,.6*e);this.visible=e>.4*this.width,this.rotation.x=t<0?Math.PI:0,this.shaft.scale.set(this.width,Math.max(e-i,1e-6),this.width),this.shaft.position.z=(e-i)/2,this.head.scale.set(this.width,Math.max(i,1e-6),this.width),this.head.position.z=e-i/2}},fc=class extends be{constructor(t,{ghost:e=!1}={}){super(),Object.assign(this,{vehicle:t,ghost:e,paint:KM(e),parts:{},touched:null}),this.alarm=new Ai({transparent:!0,opacity:.85,side:Ie,forceSinglePass:!0});let i=t.rod_length,n=Math.max(...t.rotor_positions.map(r=>Math.hypot(...r)));this.body=new be,this.add(this.body,this.#s(i)),this.#t(n),this.rim=jM(e?.4:.85),this.thrust=new dc(.085*i,Am(!0),this.rim,1.8);for(let r of[this.body,this.pole])r.traverse(o=>o.layers.enable(Xs));for(let r of this.arrows)r.traverse(o=>o.layers.disable(Xs));this.body.add(this.thrust),this.traverse(r=>r.frustumCulled=!1)}built(t){return YM.every(e=>JSON.stringify(t[e])===JSON.stringify(this.vehicle[e]))}#t(t){let{vehicle:e,paint:i,ghost:n}=this,r=e.mount==="hub",{hub_radius:o,arm_radius:a}=r?e.body:{hub_radius:0,arm_radius:.045*t},l=r?0:.13*t;e.mount==="cup"&&this.#n();let c=e.rotor_positions.map(d=>new L(...d)),h=c.map(d=>d.clone().add(new L(0,0,l))),u=r?[new sn(o,a,14,48)]:eS(t);for(let d of h)u.push(...Sm(e.rotor_radius,.13*t,d));c.forEach((d,f)=>{let p=QM(d.clone().setLength(o),d,a,r?1:.6666666666666666);r?this.#e(`arm ${f+1}`,p):u.push(tS(p))}),this.body.add(Vu(Pn(u),i.body,n),this.#i(h))}#e(t,e){Object.assign(e,{material:this.paint.body,castShadow:!this.ghost}),this.parts[t]=[e],this.body.add(e)}#i(t){let{vehicle:e,paint:i,ghost:n}=this,r=Math.max(...t.map(({x:l})=>l))-1e-9,o=Am(!1),a=t.map(({x:l})=>l>r?"front":"rear");return this.rotors=new uc(e.rotor_radius,t,e.rotor_spins,a,i,n),this.arrows=t.map(l=>new dc(.02*e.rod_length,o,i.thrust)),this.arrows.forEach((l,c)=>l.position.copy(t[c])),this.body.add(...this.arrows),this.rotors}#n(){let{vehicle:t,ghost:e}=this,i=t.body.cup_angle,n=qM*t.rod_length,r=n*Math.cos(i),o=n*Math.sin(i),a=new Ai({transparent:!0,opacity:e?.12:.3,side:Ie,depthWrite:!1,forceSinglePass:!0}),l=new Wt(new je(o,0,r,48,1,!0),a),c=Vu(new sn(o,.008*t.rod_length,8,64),this.paint.body,e);l.rotation.x=Math.PI/2,l.position.z=r/2,c.position.z=r,this.glass=a,this.body.add(l,c),Object.assign(this.parts,{cone:[l,c],cup:[l,c]})}#s(t){let{paint:e,ghost:i}=this;this.pole=new be;let n=this.vehicle.mount==="gimbal"?.016*t:this.vehicle.body.rod_radius,{rod_end:r,mount:o}=this.vehicle,a=o==="gimbal"?this.#r():null,l=a?.radius??0,c=new je(n,n,r-l,16).rotateX(Math.PI/2).translate(0,0,(r+l)/2),h=new Sn(.08*t,36,24).translate(0,0,t),u=a?.bars??[new Sn(.032*t,20,14)];return this.pole.add(Vu(Pn([c,h,...u]),e.rod,i)),this.pole}#r(){let{rotor_positions:t,rotor_radius:e,rod_length:i,rod_end:n}=this.vehicle,r=Math.max(...t.map(l=>Math.hypot(...l)))+e,o=Math.min(Gu.room*r,Gu.most*n),a=()=>new sn(o,Gu.thick*i,8,72);return{radius:o,bars:[a(),a().rotateX(Math.PI/2),a().rotateY(Math.PI/2)]}}touch(t){if(t!==this.touched){for(let e of this.parts[this.touched]??[])e.material=e.userData.paint,e.scale.set(1,1,1);for(let e of this.parts[t]??[])Object.assign(e,{userData:{paint:e.material},material:this.alarm}),t.startsWith("arm")&&e.scale.set(Em,1,Em);this.rotors.touch(/^disc/.test(t)?Number(t.slice(5))-1:-1),this.touched=t}}show(t){let{vehicle:e}=this,i=Math.max(e.weight,1e-9),n=(o,a,l)=>{let c=l*o/a;return e.rod_length*Math.max(Math.min(c,l*wm/zu),-l*wm/zu)};this.position.set(...t.x),this.body.quaternion.set(...t.quat_xyzw),this.pole.quaternion.setFromUnitVectors(WM,new L(...t.y)),this.thrust.stretch(n(t.thrust,i,zu));let r=i/this.arrows.length;this.arrows.forEach((o,a)=>{this.rotors.show(a,t.turned[a],t.rotor_forces[a]/r),o.stretch(n(t.rotor_forces[a],r,XM))})}colour(t){let e=i=>this.ghost?t.ghost:t[i];for(let[i,n]of Object.entries(this.paint))n.color.set(e(i));this.rim.uniforms.color.value.set(e("thrust")),this.glass?.color.set(e("body")),this.rotors.colour(e,t.failed),this.alarm.color.set(t.failed)}};var ln=5,iS=`
attribute vec3 from, to;
attribute vec2 begun, ended;
uniform vec2 resolution;
uniform float width;
varying float time, along;
void main() {
  vec4 a = projectionMatrix * modelViewMatrix * vec4(from, 1.0);
  vec4 b = projectionMatrix * modelViewMatrix * vec4(to, 1.0);
  float nearest = 1e-3;
  if (a.w < nearest && b.w < nearest) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
  if (a.w < nearest) a = mix(a, b, (nearest - a.w) / (b.w - a.w));
  if (b.w < nearest) b = mix(b, a, (nearest - b.w) / (a.w - b.w));
  vec2 way = (b.xy / b.w - a.xy / a.w) * resolution;
  way = length(way) > 1e-6 ? normalize(way) : vec2(1.0, 0.0);
  vec4 here = mix(a, b, position.x);
  vec2 offset = vec2(-way.y, way.x) * position.y + way * (position.x - 0.5) * 0.7;
  here.xy += offset * width / resolution * here.w;
  time = mix(begun.x, ended.x, position.x);
  along = mix(begun.y, ended.y, position.x);
  gl_Position = here;
}`,nS=`
uniform vec3 color, behind;
uniform float now, tail, faint, opacity, dash;
varying float time, along;
void main() {
  if (time > now) discard;
  if (dash > 0.0 && fract(along / dash) > 0.55) discard;
  float age = clamp((now - time) / tail, 0.0, 1.0);
  gl_FragColor = vec4(mix(behind, color, opacity * mix(1.0, faint, age)), 1.0);
  #include <colorspace_fragment>
}`,qs=class extends Wt{constructor(t,e,{width:i=2,tail:n=1,faint:r=1,opacity:o=1,dash:a=0}={}){let l=new eo;l.setAttribute("position",new qt([0,-1,0,1,-1,0,1,1,0,0,1,0],3)),l.setIndex([0,1,2,0,2,3]),super(l,new Me({vertexShader:iS,fragmentShader:nS,uniforms:{resolution:{value:new lt(1,1)},color:{value:new Ct},behind:{value:new Ct},width:{value:i},now:{value:1/0},tail:{value:n},faint:{value:r},opacity:{value:o},dash:{value:a}}})),this.frustumCulled=!1,this.put(t,e)}put(t,e){this.count=0,this.add(t,e)}add(t,e){let i=this.count,n=i+e.length,r=this.#t(n).array;for(let o=i,a=0,l=ln*i;o<n;o++,a+=3,l+=ln){let[c,h,u]=[t[a],t[a+1],t[a+2]],d=o?Math.sqrt((c-r[l-5])**2+(h-r[l-4])**2+(u-r[l-3])**2):0;r[l]=c,r[l+1]=h,r[l+2]=u,r[l+3]=e[o-i],r[l+4]=(o?r[l-1]:0)+d}this.points.addUpdateRange(ln*i,ln*e.length),this.points.needsUpdate=!0,this.count=n,this.geometry.instanceCount=Math.max(n-1,0),this.visible=n>1}#t(t){if(!this.points||this.points.count<t){let e=this.points?.array.subarray(0,ln*this.count)??[];this.points&&this.geometry.dispose(),this.points=new io(new Float32Array(ln*(this.points?2*t:Math.max(t,2))),ln),this.points.array.set(e);let i=(n,r,o)=>this.geometry.setAttribute(n,new Rs(this.points,r,o));i("from",3,0),i("to",3,ln),i("begun",2,3),i("ended",2,ln+3)}return this.points}draw(t,e,i){this.material.uniforms.now.value=t,this.material.uniforms.resolution.value.set(e,i)}colour(t,e){this.material.uniforms.color.value.set(t),this.material.uniforms.behind.value.set(e)}};var sS=.06,rS=12e3,oS=.2,aS=.12,xo=class extends be{constructor(t,e,i){super(),this.flight=t,this.model=i?.model.built(t.vehicle)?i.model:new fc(t.vehicle,{ghost:e}),this.model.vehicle=t.vehicle;let n=t.vehicle.rod_length,{times:r,pivots:o,bobs:a,references:l}=lS(t);Object.assign(this,{pivots:o,bobs:a,base:o[2]});let c=e?.7:1;this.trail=new qs(this.bobs,r,{width:2.6,tail:1.2,faint:.28,opacity:c}),this.track=new qs(this.pivots,r,{width:1.4,tail:1.2,faint:.3,opacity:.7*c}),this.planned=new qs(l,r,{width:1.6,opacity:.9,dash:.25*n});let h=()=>new sn(.09*n,.008*n,8,40);this.paint=new Ai({transparent:!0,opacity:.9}),this.marker=new Wt(Pn([h(),h().rotateX(Math.PI/2),h().rotateY(Math.PI/2)]),this.paint),this.add(this.track,this.trail,this.planned,this.marker,this.model)}grow(t,e){let{flight:i}=this,{x:n,y:r}=i.columns,o=e||!this.until?Qe(i.t,i.end-t):Qe(i.t,this.until)+1,a=i.t.subarray(o),l=i.vehicle.rod_length,c=3*a.length;Object.assign(this,{pivots:new Float64Array(c),bobs:new Float64Array(c)});for(let h=0,u=3*o;h<c;h++){let d=h%3&&i.e3==="down"?-1:1;this.pivots[h]=d*n[u+h],this.bobs[h]=d*(n[u+h]+l*r[u+h])}for(let[h,u]of[[this.trail,this.bobs],[this.track,this.pivots]])e||!this.until?h.put(u,a):h.add(u,a);this.until=i.end}show(t){this.pose=Dc(t,this.flight.e3),this.model.show(this.pose),this.model.touch(t.t>=this.flight.end?this.flight.verdict.part:null);let{x:e,x_ref:i}=this.pose,n=$e(e.map((r,o)=>r-i[o]));this.marker.position.set(...i),this.paint.opacity=.9*Te(n/(oS*this.flight.vehicle.rod_length),aS,1)}draw(t,e,i){this.model.scale.setScalar(i);for(let n of[this.trail,this.track])n.draw(this.pose.t,t,e);this.planned.draw(1/0,t,e)}colour(t){this.model.colour(t),this.trail.colour(this.model.ghost?t.ghost:t.trail,t.sky),this.track.colour(this.model.ghost?t.ghost:t.ink,t.sky),this.planned.colour(t.reference,t.sky),this.paint.color.set(t.reference)}};function lS(s){let t=[],e=Math.max(1,Math.floor(rS/s.t.length)),i=s.vehicle.rod_length;s.t.forEach((a,l)=>{let c=l+1<s.t.length?s.t[l+1]-a:0,h=Math.min(e,Math.max(1,Math.ceil(c*$e(s.sample("y_dot",l))/sS)));for(let u=0;u<(c?h:1);u++)t.push(a+u/h*c)});let[n,r,o]=[0,1,2].map(()=>new Float64Array(3*t.length));return t.forEach((a,l)=>{let{x:c,y:h,x_ref:u}=Dc(s.at(a),s.e3);n.set(c,3*l),r.set(c.map((d,f)=>d+i*h[f]),3*l),o.set(u,3*l)}),{times:t,pivots:n,bobs:r,references:o}}var cS=.3,hS=.3,uS=1.2,Tm={alone:{sky:2.4,fill:1.3},room:{sky:.8,fill:.8}},Ln=5,Hu=`
varying vec3 place;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  place = world.xyz;
  gl_Position = projectionMatrix * viewMatrix * world;
}`,dS=`
uniform vec3 color;
uniform vec2 middle;
uniform float spacing, radius;
uniform vec4 shade; // middle, radius and strength
varying vec3 place;
float lines(float step) {
  vec2 cell = place.xy / step, width = fwidth(cell);
  vec2 near = abs(fract(cell - 0.5) - 0.5) / max(width, 1e-6);
  vec2 shown = (1.0 - clamp(near - 0.1, 0.0, 1.0)) * (1.0 - smoothstep(0.15, 0.6, width));
  return max(shown.x, shown.y);
}
void main() {
  float fade = 1.0 - smoothstep(0.25, 1.0, length(place.xy - middle) / radius);
  float strength = max(0.09, max(0.3 * lines(spacing), 0.55 * lines(5.0 * spacing)));
  float drawn = strength * fade, edge = max(1.0 - dot(place.xy - shade.xy, place.xy - shade.xy) / (shade.z * shade.z), 0.0);
  float shaded = shade.w * edge * edge * (1.0 - drawn);
  gl_FragColor = vec4(color * drawn / max(drawn + shaded, 1e-6), drawn + shaded);
  #include <colorspace_fragment>
}`,fS=`
uniform vec3 middle;
uniform float spacing, size;
varying float shown;
void main() {
  vec3 place = (position + floor(middle / spacing + 0.5)) * spacing;
  vec4 view = viewMatrix * vec4(place, 1.0);
  float away = length(place - middle) / spacing;
  shown = (1.0 - smoothstep(${(Ln-2).toFixed(1)}, ${Ln.toFixed(1)}, away)) * smoothstep(0.3, 1.2, -view.z / spacing);
  gl_Position = projectionMatrix * view;
  gl_PointSize = size;
}`,pS=`
uniform vec3 color;
uniform float strength;
varying float shown;
void main() {
  float edge = length(gl_PointCoord - 0.5);
  gl_FragColor = vec4(color, 0.6 * strength * shown * (1.0 - smoothstep(0.3, 0.5, edge)));
  #include <colorspace_fragment>
}`;function Rm(s,t,e){return new Me({vertexShader:s,fragmentShader:t,uniforms:e,transparent:!0,depthWrite:!1})}var pc=class extends be{constructor(t,e,i){super(),Object.assign(this,{ground:t,reach:e,lamps:i?Tm.room:Tm.alone}),this.grid=new Wt(new Mn(1,1),Rm(Hu,dS,{color:{value:new Ct},middle:{value:new L},spacing:{value:1},radius:{value:10},shade:{value:new fe}})),this.floor=new Wt(new Mn(1,1),new $r({depthWrite:!1})),this.floor.receiveShadow=!0,this.dust=new Lr(mS(),Rm(fS,pS,{color:{value:new Ct},middle:{value:new L},spacing:{value:1},size:{value:2},strength:{value:1}})),this.dust.frustumCulled=!1,this.grid.renderOrder=-2,this.floor.renderOrder=-1,this.add(this.grid,this.floor,this.dust,new Jr(16777215,13683908,this.lamps.sky),this.#t()),this.traverse(n=>n.isLight&&n.layers.enable(Xs))}#t(){this.sun=new Us(16777215,1.4);let{shadow:t}=this.sun,e=2.6*this.reach;this.sun.castShadow=!0,t.mapSize.set(1024,1024),Object.assign(t.camera,{left:-e,right:e,top:e,bottom:-e,near:.1*this.reach}),t.radius=2.5;let i=new be;return this.fill=new Us(16777215,this.lamps.fill),i.add(this.sun,this.sun.target,this.fill),i}surround(t,{target:e,distance:i,back:n,follow:r},o,a){let l=Math.max(14*i,40*o);this.grid.position.set(e[0],e[1],this.ground),this.grid.scale.set(l,l,1);let c=this.grid.material.uniforms,h=this.dust.material.uniforms;c.middle.value.set(e[0],e[1],0),c.spacing.value=o,c.radius.value=l/2.2,h.middle.value.set(...e),h.spacing.value=Ii(i/9),h.size.value=a,h.strength.value=r,this.fill.position.set(...n);let u=6*this.reach,{camera:d}=this.sun.shadow;this.sun.target.position.set(...t),this.sun.position.set(t[0]+.12*u,t[1]+.08*u,t[2]+u);let f=t[2]-this.ground,p=2.1*d.right;this.floor.position.set(t[0]-.12*f,t[1]-.08*f,this.ground),this.floor.scale.set(p,p,1);let _=Math.max(f,0),m=this.floor.material.opacity/(1+uS*(_/this.reach)**2);c.shade.value.set(t[0],t[1],this.reach+hS*_,m),d.far=1.2*(u+Math.max(t[2]-this.ground,0))+this.reach,d.updateProjectionMatrix()}colour(t){this.grid.material.uniforms.color.value.set(t.grid),this.dust.material.uniforms.color.value.set(t.grid),this.floor.material.opacity=cS*(new Ct(t.sky).getHSL({}).l>.5?1:2)}};function mS(){let s=[];for(let t=-Ln;t<=Ln;t++)for(let e=-Ln;e<=Ln;e++)for(let i=-Ln;i<=Ln;i++)s.push(t,e,i);return new _e().setAttribute("position",new qt(s,3))}var Cm=1.5,gS=2,xS=.25,_S=.8,Im=1.6,vS=`
uniform vec3 dark, bright;
uniform float band, zero;
varying vec3 place;
void main() {
  gl_FragColor = vec4(mod(floor((place.z - zero) / band), 2.0) < 0.5 ? dark : bright, 1.0);
  #include <colorspace_fragment>
}`,mc=class extends Wt{constructor(t,e,i,n,r){let o=n+gS*r,a=new je(.012*r,.012*r,o-i,10).rotateX(Math.PI/2);super(a,new Me({vertexShader:Hu,fragmentShader:vS,uniforms:{dark:{value:new Ct},bright:{value:new Ct},band:{value:Ii(xS*r)},zero:{value:t[2]}}}));let l=Math.hypot(e[0],e[1])||1;this.position.set(t[0]-Cm*r*e[1]/l,t[1]+Cm*r*e[0]/l,(i+o)/2),Object.assign(this,{zero:t[2],ground:i,end:o,step:Ii(_S*r),reach:r,frustumCulled:!1})}marks(t){let{zero:e,step:i,reach:n,position:{x:r,y:o}}=this,a=Math.ceil((Math.max(t-Im*n,this.ground)-e)/i),l=Math.floor((Math.min(t+Im*n,this.end)-e)/i);return Array.from({length:Math.max(l-a+1,0)},(c,h)=>({height:(a+h)*i,place:[r,o,e+(a+h)*i]}))}colour(t){this.material.uniforms.dark.value.set(t.muted),this.material.uniforms.bright.value.set(t.paper)}};var Pm=.7,yS=.01,gc=class extends be{constructor(t){super(),this.plates=new Ai({transparent:!0,opacity:.1,side:Ie,depthWrite:!1}),this.edges=new Is({transparent:!0,opacity:.8});for(let e of t)this.add(this.#t(e))}#t({centre:t,axes:e,halves:[i,n],depth:r}){let o=new be,a=2*Math.max(i,n),l=Math.max(r,yS*a),c=Lm(i,n),h=Lm(i+Pm*a,n+Pm*a),u=new Ls().setFromPoints(h);u.holes.push(new Yn().setFromPoints(c)),o.add(new Wt(new Xr(u,{depth:l,bevelEnabled:!1}).translate(0,0,-l/2),this.plates));for(let _ of[c,h])for(let m of[-l/2,l/2])o.add(this.#e(_,m));let[d,f,p]=e.map(_=>new L(..._));return o.applyMatrix4(new re().makeBasis(d,f,p).setPosition(...t)),o}#e(t,e){let i=t.flatMap(({x:n,y:r})=>[n,r,e]);return new Pr(new _e().setAttribute("position",new qt(i,3)),this.edges)}colour(t){for(let e of[this.plates,this.edges])e.color.set(t.muted)}};function Lm(s,t){return[[-s,-t],[s,-t],[s,t],[-s,t]].map(([e,i])=>new L(e,i,0))}var Nm={under:1.25,below:.35},bS=.03,MS=.55,SS=.04,wS=/swiftshader|llvmpipe|softpipe|software|basic render/i,ES=70,Dm=12,AS=.9,Om=["overlay","beside"],_c=class{constructor(t,e){this.renderer=new rc({canvas:t,antialias:!0,alpha:!0}),this.renderer.outputColorSpace=Ze,Object.assign(this.renderer.shadowMap,{enabled:!0,type:Jn}),Object.assign(this,{canvas:t,layout:"overlay",views:[],flyers:[],ghosts:[],left:[],holds:new Set}),this.scene=new qn,this.#t(),this.closeUp=new hc,this.barred=new cc,this.scene.add(this.barred),this.camera=new Oe,this.camera.matrixAutoUpdate=!1,this.load(e)}#t(){if(wS.test(TS(this.renderer.getContext())))return;let t=new Vs(this.renderer),e=new lc;this.scene.environment=t.fromScene(e,SS).texture,this.scene.environmentRotation=new mi(Math.PI/2,0,0),this.scene.environmentIntensity=MS,e.dispose(),t.dispose()}load(t){this.left.push(...this.#i()),this.scene.remove(...this.left),this.flyers=t.map((o,a)=>new xo(o,!1,this.flyers[a])),this.ghosts=t.map((o,a)=>a?new xo(o,!0,this.ghosts[a]):null);let e=Math.max(...t.map(o=>o.vehicle.reach)),i=Um(this.flyers.flatMap(o=>[o.pivots,o.bobs])),n=Array.from(this.flyers[0].pivots.subarray(0,3)),r=t[0].floor??Math.min(n[2]-Nm.under*e,i.centre[2]-i.half[2]-Nm.below*e);this.world=new pc(r,e,!!this.scene.environment),this.pole=new mc(n,t[0].direction,r,i.centre[2]+i.half[2],e),this.walls=new gc(t[0].windows??[]),this.box=i,this.rig?Object.assign(this.rig,{direction:t[0].direction,reach:e,box:this.holds.size?this.rig.box:i}):(this.rig=new Qo(t[0].direction,e,i),this.rig.choose("follow")),this.scene.add(...this.#i()),this.colours&&this.colour(this.colours)}compile(){this.renderer.compile(this.scene,this.camera)}grow(t,e){let[i]=this.flyers;if(i.grow(t,e),!i.pivots.length)return;let{centre:n,half:r}=Um([i.pivots,i.bobs]),o=n.map((l,c)=>Math.min(l-r[c],this.box.centre[c]-this.box.half[c])),a=n.map((l,c)=>Math.max(l+r[c],this.box.centre[c]+this.box.half[c]));this.box={centre:o.map((l,c)=>(l+a[c])/2),half:o.map((l,c)=>(a[c]-l)/2)},this.holds.size||(this.rig.box=this.box)}#e(){for(let t of this.left.splice(0))t.traverse(e=>{e.geometry?.dispose(),e.material?.dispose(),e.dispose?.()})}hold(t,e){e?this.holds.add(t):this.holds.delete(t),this.holds.size||(this.rig.box=this.box)}#i(){return[this.world,this.pole,this.walls,...this.flyers,...this.ghosts].filter(Boolean)}colour(t){this.colours=t;for(let e of[this.barred,...this.#i()])e.colour(t)}show(t){t.forEach((e,i)=>{this.flyers[i].show(e),this.ghosts[i]?.show(e)})}resize(t,e,i){Object.assign(this,{width:t,height:e,ratio:i,larger:si()}),this.renderer.setPixelRatio(i),this.renderer.setSize(t,e,!1)}viewports(){let{width:t,height:e,flyers:i}=this;if(this.layout==="overlay")return[{left:0,top:0,width:t,height:e,main:0}];let n=e>1.15*t,[r,o]=n?[t,e/i.length]:[t/i.length,e];return i.map((a,l)=>({left:n?0:l*r,top:n?l*o:0,width:r,height:o,main:l}))}render(t){let{renderer:e,rig:i}=this,n=this.viewports();i.aspect=n[0].width/n[0].height;let r=i.glide(Ni()?1/0:t);return e.setScissorTest(!0),this.views=n.map(o=>{let{left:a,top:l,width:c,height:h,main:u}=o,d=this.flyers[u].pose.x,f=i.apply(this.camera,d,c/h),p=$e(d.map((g,b)=>g-this.camera.position.getComponent(b)));this.factor=Ii(Math.max(1,bS*p/this.world.reach)),this.#s(u,c,h);let _=this.camera.position.z-this.world.ground;this.spacing=Ii(Math.max(f.distance,_)/9),this.world.surround(d,f,this.spacing,2.4*this.ratio*this.larger);let m=this.height-l-h;return e.setViewport(a,m,c,h),e.setScissor(a,m,c,h),e.render(this.scene,this.camera),{...o,...f,camera:this.camera.clone()}}),this.near=this.#n(),this.#e(),r}#n(){let{renderer:t,scene:e,closeUp:i,width:n,height:r,flyers:[o]}=this;if(this.layout==="beside"||!o.flight.passes(o.pose.t))return null;let{left:a,top:l,side:c}=i.place(n,r),h=[a,r-l-c,c,c];return this.world.fill.position.copy(i.aim(o.model,this.factor)),t.setViewport(...h),t.setScissor(...h),t.shadowMap.autoUpdate=!1,t.render(e,i.camera),t.shadowMap.autoUpdate=!0,{left:a,top:l,side:c,clearance:o.pose.clearance}}#s(t,e,i){let n=this.layout==="beside";this.flyers.forEach((r,o)=>{r.visible=o===t,this.ghosts[o]&&(this.ghosts[o].visible=!n),(r.visible?r:this.ghosts[o])?.draw(e/this.larger,i/this.larger,this.factor)})}screen(t,e=1){let i=this.views.find(a=>a.main===t)??this.views[0],{x:n,y:r}=this.flyers[t].pose,o=e*this.flyers[t].flight.vehicle.rod_length;return{pivot:xc(n,i),bob:xc(n.map((a,l)=>a+o*r[l]),i)}}locate(t){return xc(t,this.views[0])}marks(){let[t]=this.views;if(!t||this.layout==="beside"||Math.abs(t.back[2])>AS)return[];let[e,i]=[t.left,t.left+t.width],[n]=this.screen(0).pivot,r=ES*this.larger;return this.pole.marks(this.flyers[0].pose.x[2]).map(({height:o,place:a})=>({height:o,at:xc(a,t)})).map(({height:o,at:a})=>({height:o,at:a,size:r,before:n>a[0]&&a[0]-e>r?r:0})).filter(({at:[o,a]})=>o>e&&o<i&&a>Dm&&a<t.height-Dm)}};function TS(s){return String(s.getParameter(s.getExtension("WEBGL_debug_renderer_info")?.UNMASKED_RENDERER_WEBGL??s.RENDERER))}function xc(s,t){let{x:e,y:i}=new L(...s).project(t.camera);return[t.left+(e+1)/2*t.width,t.top+(1-i)/2*t.height]}function Um(s){let t=[1/0,1/0,1/0],e=[-1/0,-1/0,-1/0];for(let i of s)for(let n=0;n<i.length;n++)t[n%3]=Math.min(t[n%3],i[n]),e[n%3]=Math.max(e[n%3],i[n]);return{centre:t.map((i,n)=>(i+e[n])/2),half:t.map((i,n)=>(e[n]-i)/2)}}var vc=class{constructor(t,e){Object.assign(this,{palette:t,changed:e});let i=window.matchMedia("(prefers-color-scheme: dark)");this.name=i.matches?"dark":"light",i.addEventListener("change",()=>this.set(i.matches?"dark":"light"))}get colours(){return this.palette[this.name]}set(t){if(!(t in this.palette))return!1;this.name=t,document.documentElement.dataset.theme=t;for(let[e,i]of Object.entries(this.colours))document.documentElement.style.setProperty(`--${e}`,i);return this.changed(this.colours),!0}toggle(){this.set(this.name==="dark"?"light":"dark")}};var Fm=1/30,RS=380,CS=480,IS=80,$s=class{constructor({runs:t,palette:e,title:i,layout:n,speed:r},o=Io){this.parts=Td(o,i),this.title=i,this.drawn={count:0,cost:[]},this.clock=new Po(0,0,()=>this.wake()),this.clock.speed=r,this.player=new No(this.parts.player,this.clock),this.plots=[],this.portrait=new Ko(this.parts.low,a=>this.clock.seek(a)),this.theme=new vc(e,a=>this.#a(a)),this.#s(),this.flights=[],addEventListener("message",({source:a,data:l})=>a===parent&&a!==window&&this.#t(l)),this.theme.set(this.theme.name),t.length&&this.load(t),this.layouts.root.hidden=this.flights.length<2,this.layout(n),this.since=null,this.#r(),new ResizeObserver(()=>this.#l()).observe(this.parts.scene),this.last=null}load(t){let e=!this.stage;this.flights=t.map(r=>r instanceof Fn?r:new Fn(r));let i=this.flights.map(r=>r.end),n=this.flights.map(r=>r.start);this.clock.span(Math.min(...n),Math.max(...i)),this.player.mark(this.flights),Rd(this.parts.legend,this.flights),this.parts.canvas.setAttribute("aria-label",`The flight in three dimensions: ${this.flights.map(({title:r,verdict:o})=>`${r}, ${o.words}`).join("; ")}`),this.#e($c(this.flights)),this.portrait.load(this.flights),this.layouts.root.hidden=this.flights.length<2,this.player.show(),this.#i(),e&&this.#n(),e&&this.stage?.compile(),this.flights.length<2&&this.layout("overlay"),this.#h(),this.wake()}#t(t){t?.letters>0&&(document.documentElement.style.fontSize=`${14*t.letters}px`),this.theme.set(t?.theme)}open(t){if(!Ni()){this.opening=new Yo(this,t);return}let{invite:e}=this.parts;Object.assign(e,{hidden:!1,textContent:"Press play, or the space bar"});let[i]=this.flights,{y:n}=i.at(i.start);e.classList.toggle("under",ni(n,i.e3)[2]>0);for(let r of["pointerdown","keydown"])document.addEventListener(r,()=>e.hidden=!0,{capture:!0,once:!0})}take(){this.opening?.end(),this.opening=null}#e(t){let e=this.only?t.filter(({plain:i})=>i===this.only):t;for(let i of this.plots.splice(e.length))i.root.remove();e.forEach((i,n)=>{this.plots[n]?this.plots[n].load(i):this.plots.push(new Zo(this.parts.plots,i,r=>this.clock.seek(r)))})}grown(t,e){let[i]=this.flights,{clock:n}=this;Object.assign(n,{start:i.start,end:i.end,time:n.playing?i.end:n.time}),this.stage?.grow(t,e),e?(this.#e($c(this.flights,i.end-t)),this.portrait.load(this.flights,i.end-t),this.#h()):this.portrait.grow(),this.wake()}#i(){try{this.stage?this.stage.load(this.flights):(this.stage=new _c(this.parts.canvas,this.flights),this.captions=new Vo(this.parts.scene,this.parts.low),of(this.parts.canvas,this.stage.rig,()=>this.wake())),this.captions.load(this.flights)}catch{this.parts.scene.classList.add("none"),this.parts.note.textContent="This browser shows no 3-D graphics (WebGL is off); the plots work without."}}#n(){this.cameras.show(this.stage?.rig.preset),this.stage?.colour(this.theme.colours),this.#c()}#s(){let t=[["overview","Overview","The whole flight (1)"],["side","Side","Level, beside the vehicle (2)"],["follow","Follow","Behind the vehicle (3)"],["axis","Above","From above, along gravity: the paper's camera on its \u2212e\u2083 axis (4)"]];this.cameras=new Li(this.parts.choices,"Camera",t,n=>this.camera(n));let e=[["overlay","Overlay","One picture, the others as ghosts (g)"],["beside","Side by side","A picture for each (g)"]];this.layouts=new Li(this.parts.choices,"Layout",e,n=>this.layout(n)),this.movies=new Li(this.parts.choices,"Movie",[["movie","Movie","Save the flight as a movie, at the chosen speed (m)"]],()=>this.film()),this.sizes=Object.assign(document.createElement("select"),{className:"sizes",ariaLabel:"Size of movies and pictures"}),this.sizes.append(...Object.keys(jc).map(n=>new Option(n,n))),this.movies.root.append(this.sizes),this.movies.root.hidden=!Kc(),this.movies.show("");let i=[["toggle","\u25D0","Light or dark (t)"]];this.themes=new Li(this.parts.choices,"Theme",i,()=>this.theme.toggle()),this.helps=new Li(this.parts.choices,"Help",[["help","?","What everything does (?)"]],()=>rh(document.querySelector("main")))}#r(){let{clock:t}=this;Do({" ":()=>t.toggle(),ArrowLeft:e=>t.seek(t.time-(e?1:Fm)),ArrowRight:e=>t.seek(t.time+(e?1:Fm)),ArrowUp:()=>t.shift(1),ArrowDown:()=>t.shift(-1),Home:()=>t.seek(t.start),End:()=>t.seek(t.end),g:()=>this.layout(this.stage?.layout==="overlay"?"beside":"overlay"),t:()=>this.theme.toggle(),m:()=>this.film(),s:()=>this.portrait.fold(),"?":()=>rh(document.querySelector("main")),...Object.fromEntries(ah.map((e,i)=>[String(i+1),()=>this.camera(e)]))})}get size(){return jc[this.sizes.value]}film(){let{clock:t}=this;!this.stage||!Kc()||(this.take(),this.filming?this.filming.stop():t.drive&&this.since===null?(this.since=t.time,this.movies.show("movie")):this.#o(t.drive?Math.max(this.since,t.start):t.start))}async#o(t){let{clock:e,movies:{buttons:[i]}}=this,n=this.title.replaceAll(/[^\p{L}\p{N}]+/gu,"-"),{playing:r}=e;e.pause(),this.filming=new Wo(this,this.size,o=>i.textContent=`${Math.round(100*o)} %`),this.parts.scene.classList.add("filming"),this.movies.show("movie"),this.parts.note.textContent="";try{let o=await this.filming.shoot(t,e.end);o&&rr(o,`${n}.webm`)}catch({message:o}){this.parts.note.textContent=`There is no movie: ${o}`}finally{Object.assign(this,{filming:null,since:null}),i.textContent="Movie",this.movies.show(""),this.parts.scene.classList.remove("filming"),this.resume(),e.drive&&r&&e.play()}}expose({width:t,height:e,scale:i},n){this.stage.resize(t/i,e/i,i),this.stage.show(this.#u()),this.stage.render(n)}resume(){this.#c(),this.wake()}camera(t){return this.stage?.rig.choose(t)?(this.cameras.show(t),this.wake(),!0):!1}layout(t){return!this.stage||!Om.includes(t)||t==="beside"&&this.flights.length<2?!1:(this.stage.layout=t,this.layouts.show(t),this.parts.scene.dataset.layout=t,this.wake(),!0)}#a(t){this.stage?.colour(t),this.#h(),this.wake()}#l(){this.#c()&&this.#d(0)}#c(){let{stage:t,parts:{scene:{clientWidth:e,clientHeight:i}}}=this,n=Math.min(window.devicePixelRatio||1,2);if(!t||!e||!i||t.width===e&&t.height===i&&t.ratio===n)return!1;t.resize(e,i,n);let r=i<RS||e<CS;return r&&!this.small&&this.portrait.fold(!0),this.small=r,!0}#h(){for(let t of this.plots)t.draw(this.theme.colours),t.show(this.clock.time);this.flights.length&&(this.portrait.draw(this.theme.colours),this.portrait.show(this.#u()))}#u(){return this.flights.map(t=>t.at(this.clock.time))}wake(){this.dirty=!0,this.waiting??=requestAnimationFrame(t=>this.#f(t))}#f(t){this.waiting=void 0;let e=this.last===null?0:Math.min((t-this.last)/1e3,.25);this.dirty=!1,this.clock.tick(e);let i=this.#d(e),n=this.clock.playing||i||this.dirty;this.last=n?t:null,n&&this.wake()}#d(t){let e=performance.now(),{stage:i,clock:n}=this,r=!n.playing||!(e-this.told<IS);r&&(this.told=e);let o=this.#u(),a=!1;i?.width&&!this.filming&&(i.show(o),a=i.render(t||1/60),this.captions.show(i,n.time,this.theme.colours,r)),this.opening?.frame(),this.player.show(r);for(let l of this.plots)l.show(n.time,r);return o.length&&this.portrait.show(o,r),this.drew?.(),this.drawn.count+=1,this.drawn.cost=[...this.drawn.cost.slice(-59),performance.now()-e],a}offer(){let{clock:t}=this,e=i=>n=>(this.take(),i(n));return Object.freeze({play:e(()=>t.play()),pause:e(()=>t.pause()),speed:e(i=>t.setSpeed(i)),seek:i=>{this.opening&&t.pause(),this.take(),t.seek(i)},time:()=>t.time,duration:()=>t.end-t.start,playing:()=>t.playing,load:e(i=>this.load(i)),camera:i=>this.camera(i),layout:i=>this.layout(i),theme:i=>this.theme.set(i),pose:(i=0)=>{let n=this.flights[i].at(t.time);return{...n,R:js(n.quat_xyzw)}},floor:()=>this.stage?.world.ground??null,phases:(i=0)=>structuredClone(this.flights[i].phases),recoveries:(i=0)=>this.flights[i].recoveries(t.time).all.map(({begin:n,end:r,distance:o,lost:a})=>({begin:n,time:r===null?null:r-n,distance:o,height_lost:a})),screen:(i=0)=>this.stage?(this.#d(0),this.stage.screen(i)):null,frames:()=>({count:this.drawn.count,milliseconds:[...this.drawn.cost]})})}};function km({place:s,stiffness:t,damping:e,most:i},n,r){let o=s.map((l,c)=>t*(l-n[c])-e*r[c]),a=Math.hypot(...o);return a>i?o.map(l=>l*i/a):o}var PS=Math.PI/36,LS=.6,yc={turns:9,wide:5},NS={ArrowLeft:[-1,0],ArrowRight:[1,0],ArrowUp:[0,1],ArrowDown:[0,-1]},bc=class{constructor(t,e,i){Object.assign(this,{viewer:t,moved:e,pulled:i,ray:new no,going:!1}),this.root=document.createElement("button"),Object.assign(this.root,{type:"button",className:"handle"}),this.root.dataset.keys="",this.invite=document.createElement("span"),this.invite.className="invite",this.root.append(this.invite),this.#e(!1),this.coil=document.createElementNS("http://www.w3.org/2000/svg","svg"),this.coil.classList.add("coil"),this.coil.setAttribute("aria-hidden","true"),this.coil.innerHTML="<polyline/>",this.newtons=Object.assign(document.createElement("p"),{className:"newtons",hidden:!0}),t.parts.scene.append(this.coil,this.newtons,this.root),this.root.addEventListener("pointerdown",n=>{this.root.setPointerCapture(n.pointerId),this.#i(!0),n.stopPropagation()}),this.root.addEventListener("pointermove",n=>this.held&&this.#n(n));for(let n of["pointerup","pointercancel","lostpointercapture"])this.root.addEventListener(n,()=>this.#i(!1));this.root.addEventListener("keydown",n=>this.#o(n));for(let n of["keyup","blur"])this.root.addEventListener(n,()=>this.going&&!this.held&&this.pulled(null))}get flyer(){return this.viewer.stage?.flyers[0]}show(t,e){let{viewer:i,flyer:n}=this,{clock:r}=i;t!==this.going&&this.#e(t),this.root.hidden=!n||!t&&(r.playing||r.time>r.start+1e-9);let o=!this.root.hidden&&!t;if(n&&i.stage.barred.place(o&&n.pose.x,i.stage.factor*n.flight.vehicle.rod_length)&&i.wake(),this.#t(t&&n?e:null),this.root.hidden)return;let[a,l]=i.stage.screen(0,i.stage.factor).bob;this.held||(this.y=n.pose.y),this.pivot=n.pose.x,Pi(this.root,`translate(${a.toFixed(1)}px, ${l.toFixed(1)}px)`),this.root.classList.toggle("deep",2*l>i.stage.height)}#t(t){if(this.newtons.hidden=!t,this.coil.classList.toggle("none",!t),!t)return;let{pose:{x_dot:e,y_dot:i},flight:{vehicle:{rod_length:n}}}=this.flyer,r=this.#r(),o=$e(km(t,r,e.map((c,h)=>c+n*i[h]))),a=this.viewer.stage.locate(r),l=this.viewer.stage.locate(t.place);this.coil.firstChild.setAttribute("points",DS(a,l).map(c=>c.map(h=>h.toFixed(1)).join()).join(" ")),Se(this.newtons,`${o.toFixed(1)} N`),Pi(this.newtons,`translate(${l[0].toFixed(1)}px, ${l[1].toFixed(1)}px)`)}#e(t){this.going=t,this.root.title=t?"Drag the bob and fling it (arrow keys pull)":"Drag the rod to set the start (arrow keys turn it)",this.invite.textContent=t?"Grab the ball":"Drag to set the start",this.root.setAttribute("aria-label",`${this.invite.textContent}: ${t?"bob in flight":"rod"}`)}#i(t){this.held!==t&&(t&&(this.invite.hidden=!0),this.held=t,this.going&&!t&&this.pulled(null),this.viewer.stage.hold("rod",t&&!this.going),this.viewer.wake())}#n(t){let{viewer:e,flyer:i}=this,n=e.stage.views[0],r=e.parts.canvas.getBoundingClientRect(),o=(t.clientX-r.left-n.left)/n.width,a=(t.clientY-r.top-n.top)/n.height;this.ray.setFromCamera(new lt(2*o-1,1-2*a),n.camera);let l=this.ray.ray.origin.toArray(),c=this.ray.ray.direction.toArray();if(this.going){this.pulled(this.#s(l,c,n.back));return}let h=i.pose?.x??this.pivot,u=i.flight.vehicle.rod_length*e.stage.factor;this.y=US(l.map((d,f)=>(d-h[f])/u),c,this.y),this.moved(this.y)}#s(t,e,i){let n=this.#r(),r=ye(n.map((o,a)=>o-t[a]),i)/ye(e,i);return t.map((o,a)=>o+r*e[a])}#r(){let{pose:t,flight:e}=this.flyer;return t.x.map((i,n)=>i+e.vehicle.rod_length*t.y[n])}#o(t){let e=NS[t.key];if(!e)return;if(t.preventDefault(),this.invite.hidden=!0,this.going){let{right:o,up:a}=this.viewer.stage.views[0],l=LS*this.flyer.flight.vehicle.rod_length;this.pulled(this.#r().map((c,h)=>c+l*(e[0]*o[h]+e[1]*a[h])));return}let{right:i,up:n}=this.viewer.stage.views[0],r=Math.sin(PS);this.y=ui(this.y.map((o,a)=>o+r*(e[0]*i[a]+e[1]*n[a]))),this.moved(this.y)}};function DS(s,t){let e=t.map((o,a)=>o-s[a]),i=Math.hypot(...e)||1,n=[-e[1]/i,e[0]/i],r=Array.from({length:yc.turns},(o,a)=>{let l=(a+1)/(yc.turns+1),c=a%2?yc.wide:-yc.wide;return s.map((h,u)=>h+l*e[u]+c*n[u])});return[s,...r,t]}function US(s,t,e){let i=ye(s,t),n=i**2-ye(s,s)+1,r=a=>ui(s.map((l,c)=>l+a*t[c]));if(n<=0)return r(-i);let o=[r(-i-Math.sqrt(n)),r(-i+Math.sqrt(n))];return ye(o[0],e)>=ye(o[1],e)?o[0]:o[1]}var Mc=["#00224e","#3b496c","#7d7c78","#bcae6c","#fee838"],OS=200,FS=`<div class="disc"><canvas role="img" aria-label="Region of attraction over the directions of the rod"></canvas></div>
  <div class="told"><p class="share"></p><p class="hint">A point of the disc is a direction of the rod at the start, at rest; the rest of the
  start is that of the flight. Equal areas are equal shares of the sphere. Touch a point to fly from there.</p>
  <div class="scale"><span>0 s</span><i></i><span class="longest"></span><b></b><span>does not settle</span></div><p class="here"></p></div>`,Sc=class{constructor(t,e){this.root=document.createElement("section"),Object.assign(this.root,{className:"map",innerHTML:FS,hidden:!0,ariaLabel:"Region of attraction"}),t.append(this.root);let i=n=>this.root.querySelector(n);Object.assign(this,{canvas:i("canvas"),disc:i(".disc"),share:i(".share"),longest:i(".longest"),here:i(".here"),points:[],total:0,path:[]}),this.canvas.addEventListener("click",n=>{let r=this.#n(n);r&&e(r)}),this.canvas.addEventListener("pointermove",n=>this.#s(this.#n(n))),new ResizeObserver(()=>this.draw()).observe(this.disc)}clear(t,e){Object.assign(this,{points:[],total:0,duration:t,y:e}),this.longest.textContent=`${+t.toPrecision(3)} s`,this.draw()}add({y:t,settling:e,cause:i,done:n,total:r}){this.total=r;let o=n-t.length;t.forEach((a,l)=>this.points[o+l]={y:a,settling:e[l],cause:i[l]}),this.due??=setTimeout(()=>requestAnimationFrame(()=>this.draw()),this.points.length<r?OS:0)}follow(t){this.path=Array.from(t.t,(e,i)=>ni(t.sample("y",i),t.e3)),this.root.hidden||this.draw()}refuse(t){this.share.textContent=`not computed: ${t}`}get good(){return this.points.filter(t=>t.settling!==null).length}draw(){clearTimeout(this.due),this.due=null;let{width:t,height:e}=this.disc.getBoundingClientRect(),i=Math.floor(Math.min(t,e));if(i<20)return;this.larger=si();let n=this.size=i/this.larger;this.canvas.style.width=this.canvas.style.height=`${i}px`;let r=this.canvas.getContext("2d"),o=getComputedStyle(document.documentElement),a=d=>o.getPropertyValue(`--${d}`).trim();rs(r,n,n),r.translate(n/2,n/2),this.radius=n/2-26;let l=this.points.length,c=Math.min(this.radius/Math.sqrt(l||1),this.radius/8);r.save(),r.beginPath(),r.arc(0,0,this.radius,0,2*Math.PI),r.fillStyle=a("sky"),r.fill(),r.clip();let h=Bm(a("paper"),a("rod"),.5);this.root.style.setProperty("--failed",h);for(let d of l<30?[1]:[2.4,1.7,1.2])for(let f of this.points)r.fillStyle=f.settling===null?h:kS(f.settling/this.duration),r.beginPath(),r.arc(...this.#i(f.y),d*c,0,2*Math.PI),r.fill();this.#t(r,a),r.restore(),this.#e(r,a);let u=+(100*this.good/l).toFixed(l<500?0:1);this.share.textContent=l?`Settles from ${u} % of ${l} directions${l<this.total?"\u2026":""}`:"computing\u2026"}#t(t,e){let i=this.path.flatMap(n=>pn(n));for(let[n,r]of[[4,e("paper")],[1.8,e("ink")]])Object.assign(t,{lineWidth:n,strokeStyle:r,lineJoin:"round"}),lr(t,i,this.radius)}#e(t,e){Jo(t,this.radius,"rgb(255 255 255 / 0.45)",e("muted")),jo(t,this.radius,"up",e("muted")),t.fillText("outer edge: hanging",0,this.radius+14);let i=(o,a,l)=>{Object.assign(t,{lineWidth:4,lineJoin:"round",strokeStyle:e("paper"),fillStyle:e("ink")}),t.strokeText(o,a,l),t.fillText(o,a,l)};if(i("upright",0,0),i("level",0,this.radius*Math.SQRT1_2),!this.y)return;let[n,r]=this.#i(this.y);for(let[o,a]of[[5,e("paper")],[2.5,e("ink")]])Object.assign(t,{lineWidth:o,strokeStyle:a}),t.beginPath(),t.arc(n,r,8,0,2*Math.PI),t.stroke()}#i(t){return pn(t).map(e=>this.radius*e)}#n(t){let e=this.canvas.getBoundingClientRect(),i=n=>(n/this.larger-this.size/2)/this.radius;return sf([i(t.clientX-e.left),i(t.clientY-e.top)])}#s(t){if(this.here.textContent="",!t||!this.points.length)return;let e=r=>r.y.reduce((o,a,l)=>o+a*t[l],0),i=this.points.reduce((r,o)=>e(o)>e(r)?o:r),n=On(t[2]).toFixed(0);this.here.textContent=`${n}\xB0 from upright: ${i.settling===null?`does not settle (${i.cause})`:`settles after ${i.settling.toFixed(1)} s`}`}};function kS(s){let t=Math.min(Math.max(s,0),1)*(Mc.length-1),e=Math.min(Math.floor(t),Mc.length-2);return Bm(Mc[e],Mc[e+1],t-e)}function Bm(s,t,e){let i=(n,r)=>parseInt(n.slice(1+2*r,3+2*r),16);return`rgb(${[0,1,2].map(n=>Math.round(i(s,n)+e*(i(t,n)-i(s,n)))).join(" ")})`}var Wu=400,Ys=class{constructor(t,e,i){this.root=document.createElement("label"),this.root.className="slider",this.root.dataset.path=e.path,this.root.innerHTML=`<span class="words"></span><output></output><input type="range" min="0" max="${Wu}" step="1" data-keys>`;let n=r=>this.root.querySelector(r);Object.assign(this,{words:n(".words"),output:n("output"),input:n("input")}),this.input.setAttribute("aria-label",e.words),this.input.addEventListener("input",()=>{let r=this.#e(Number(this.input.value)/Wu);this.facts.value=r,this.#i(r),i(this.facts,r)}),this.input.addEventListener("pointerdown",()=>this.held=!0);for(let r of["pointerup","pointercancel","change"])this.input.addEventListener(r,()=>this.held=!1);t.append(this.root),this.show(e)}show(t){if(this.held)return;this.facts={...t},this.words.replaceChildren(),Uo(this.words,t.words),this.input.value=Math.round(Wu*this.#t(t.value));let[e,i]=t.allowed??[t.low,t.high];this.input.style.setProperty("--least",`${100*this.#t(e)}%`),this.input.style.setProperty("--most",`${100*this.#t(i)}%`),this.#i(t.value)}bound(){let{low:t,high:e,allowed:i,unit:n,words:r}=this.facts;return!i||i[0]<=t&&i[1]>=e?"":`With the other gains as they are, ${r} may be ${vi(+i[0].toPrecision(3))} to ${vi(+i[1].toPrecision(3))}${Yc(n)}`}#t(t){let{low:e,high:i,log:n}=this.facts;return n?Math.log(t/e)/Math.log(i/e):(t-e)/(i-e)}#e(t){let{low:e,high:i,log:n}=this.facts;return+(n?e*(i/e)**t:e+t*(i-e)).toPrecision(3)}#i(t){let{unit:e}=this.facts;this.input.style.setProperty("--done",`${100*this.#t(t)}%`);let i=`${vi(+t.toPrecision(3))}${Yc(e)}`;this.output.textContent=i,this.input.setAttribute("aria-valuetext",i)}},Zs=class{constructor(t,e){Object.assign(this,{parent:t,moved:e,sliders:[],paths:""})}show(t){let e=t.map(i=>i.path).join(" ");if(e===this.paths){t.forEach((i,n)=>this.sliders[n].show(i));return}this.paths=e,this.parent.replaceChildren(),this.sliders=t.map(i=>new Ys(this.parent,i,this.moved))}};var BS=200,zS={hehn2011:"hehn2011, 0.5 kg",nayak2018:"nayak2018, 0.4 kg"},GS=[["right","\u2192 right"],["left","\u2190 left"],["away","\u2197 away"],["towards","\u2199 towards"],["up","\u2191 up"],["down","\u2193 down"]],Xu=["gains","plant","place","defects"],VS=`<div class="five"><button type="button" class="go live" aria-pressed="false" title="Let the flight go on, and take the bob in hand (l)">Fly live</button>
  <button type="button" class="again" title="Begin again (r)">Start again</button>
  <label>Start <select class="starts"></select></label>
  <button type="button" class="kick" title="Hit the bob now (p)">Poke the ball</button>
  <button type="button" class="open" aria-expanded="false" aria-controls="tune" title="Start, pokes, gains, plant, files">Tune</button></div>`,HS=(s,t)=>`
  <section><h2>Flight <button type="button" class="small undo" title="Take back the last change (Ctrl+Z)" disabled>undo</button>
    <button type="button" class="small redo" title="Do it again (Ctrl+Shift+Z)" disabled>redo</button></h2>
    ${s?`<label class="row">Vehicle <select data-path="vehicle.base"></select></label>
    <label class="row">Mount <select data-path="vehicle.mount"></select></label>
    <label class="row">Law <select data-path="law.name"></select></label>
    <label class="row">Plant <select data-path="plant.base"></select></label>
    <label class="row">Sensors <select data-path="plant.sensors"></select></label>`:""}
    <div class="flight"></div></section>
  <section><h2>Start</h2>
    ${s?'<div class="chips papers" data-whose="Experiment"><span>paper</span></div>':""}
    <div class="rod"></div><p class="hint">Drag the rod to set the start; when live, drag the bob.</p></section>
  <section class="poke"><h2>Poke <small></small></h2>
    <div class="row two"><button type="button" data-on="bob">Poke bob</button><button type="button" data-on="vehicle">Poke vehicle</button></div>
    <label class="row">Direction <select class="way" aria-label="Direction"></select></label>
    <div class="strength"></div>
    <button type="button" class="unpoke" hidden>Remove pokes</button></section>
  <section class="has-place"><h2 data-whose="Place to hold:">Place to hold <button type="button" class="small reset" title="The reference as it is by itself">reset</button></h2><div class="place"></div></section>
  <section class="has-gains"><h2 data-whose="Gains:">Gains <button type="button" class="small reset" title="The gains that the law proposes">reset</button></h2><div class="gains"></div></section>
  <section class="has-plant"><h2 data-whose="Plant:">Plant <button type="button" class="small reset" title="The plant as it is by itself">reset</button></h2><div class="plant"></div></section>
  <section class="has-defects"><h2 data-whose="Sensor defects:">Sensor defects <button type="button" class="small reset" title="The sensors as they are by themselves">reset</button></h2>
    <p class="hint fell" role="status"></p><div class="defects"></div></section>
  ${t?`<section><h2>Export</h2>
    <div class="row two"><button type="button" data-export="toml">TOML</button><button type="button" data-export="python">Python</button></div>
    <div class="export" hidden><textarea readonly rows="9" spellcheck="false" aria-label="Export"></textarea>
    <div class="row two"><button type="button" class="copy">Copy</button><a class="save" download>Save</a></div></div></section>`:""}`,wc=class{constructor(t,e){this.lab=e,this.root=document.createElement("section");let i=!!e.offer.vehicles;this.served=i&&!e.offer.alone,Object.assign(this.root,{id:"tune",className:"panel",innerHTML:HS(i,this.served),ariaLabel:"Tune",hidden:!0}),this.bar=document.createElement("section"),Object.assign(this.bar,{className:"bar",innerHTML:VS,ariaLabel:"Controls"}),t.querySelector("header").after(this.bar,this.root),this.groups=Object.fromEntries(["flight",...Xu].map(n=>[n,new Zs(this.#t(`.${n}`),(r,o)=>e.slide(r,o))])),this.selects=[],i&&this.#e(),this.#i(),this.#n(),this.#s(),this.served&&this.#o()}#t(t){return this.root.querySelector(t)}#e(){let{offer:t}=this.lab,e={"vehicle.base":t.vehicles.map(i=>[i,zS[i]??i]),"vehicle.mount":Object.entries(t.mounts),"law.name":t.laws.map(i=>[i,i]),"plant.base":Object.entries(t.plants),"plant.sensors":Object.entries(t.sensors)};this.selects=Object.entries(e).map(([i,n])=>{let r=this.#t(`select[data-path="${i}"]`);return r.append(...n.map(([o,a])=>new Option(a,o))),r.addEventListener("change",()=>this.lab.choose(i,r.value)),r.closest("label").hidden=n.length<2,r})}#i(){let t=(e,i)=>{this[e]=this.bar.querySelector(`.${e}`),this[e].addEventListener("click",i)};t("go",()=>this.lab.running.toggle()),t("again",()=>this.lab.restart()),t("kick",()=>this.poke("bob")),t("open",()=>this.tune(this.root.hidden)),this.go.disabled=!0,this.#t(".undo").addEventListener("click",()=>this.lab.setting.undo()),this.#t(".redo").addEventListener("click",()=>this.lab.setting.redo());for(let e of Xu)this.#t(`.has-${e} .reset`).addEventListener("click",()=>this.lab.reset(e))}#n(){let{lab:t}=this,{starts:e,experiments:i}=t.offer,n=this.bar.querySelector(".starts");n.append(new Option("choose",""),...Object.keys(e).map(o=>new Option(o,o)),new Option("random","random")),n.addEventListener("change",()=>{n.value&&t.start(e[n.value]??{random:Math.floor(Math.random()*1e9)}),n.value=""});for(let[o,a]of Object.entries(i??{})){let l=document.createElement("button");Object.assign(l,{type:"button",textContent:o,title:`Experiment ${o} of the paper, its vehicle and law`}),l.addEventListener("click",()=>t.preset(a)),this.#t(".papers").append(l)}let r=[{path:"start.y.tilt",words:"rod from upright",unit:"\xB0",low:0,high:180,value:180},{path:"start.y.heading",words:"heading",unit:"\xB0",low:-180,high:180,value:0}];this.rod=r.map(o=>new Ys(this.#t(".rod"),o,()=>{let[a,l]=this.rod.map(c=>c.facts.value*Math.PI/180);t.rod([Math.sin(a)*Math.cos(l),Math.sin(a)*Math.sin(l),Math.cos(a)])}))}#s(){this.#t(".way").append(...GS.map(([e,i])=>new Option(i,e))),this.strength=new Ys(this.#t(".strength"),{path:"pokes.velocity",words:"strength",unit:"m/s",low:.1,high:10,value:1,log:!0},()=>{});for(let e of this.root.querySelectorAll("[data-on]"))e.title="Apply an impulse of this \u0394v (p)",e.addEventListener("click",()=>this.poke(e.dataset.on));this.#t(".unpoke").addEventListener("click",()=>this.lab.unpoke())}able(t){this.go.disabled=!t}tune(t){this.root.hidden=!t,this.lab.main.classList.toggle("tuned",t),this.open.setAttribute("aria-expanded",String(t)),t&&this.#r()}#r(){let t=this.root.getBoundingClientRect().top,{height:e}=this.lab.viewer.parts.scene.getBoundingClientRect();t>innerHeight-BS&&scrollBy({top:t-e,behavior:Ni()?"auto":"smooth"})}live(t){this.go.setAttribute("aria-pressed",String(t)),this.#t(".unpoke").hidden=t||!this.lab.setting.value.pokes?.length}pins(t){this.pin.setAttribute("aria-pressed",String(t))}poke(t){this.lab.poke(t,this.#t(".way").value,this.strength.facts.value)}#o(){let t=this.#t(".export"),e=t.querySelector("textarea"),i=t.querySelector(".save");for(let n of this.root.querySelectorAll("[data-export]"))n.addEventListener("click",()=>{this.exported=this.exported===n.dataset.export?null:n.dataset.export,this.#a()});t.querySelector(".copy").addEventListener("click",n=>{let{target:r}=n;e.select(),(navigator.clipboard?.writeText(e.value)??Promise.reject(new Error("no clipboard"))).catch(()=>document.execCommand("copy")).then(()=>r.textContent="Copied"),setTimeout(()=>r.textContent="Copy",1200)}),i.addEventListener("click",()=>{URL.revokeObjectURL(i.href),i.href=URL.createObjectURL(new Blob([e.value],{type:"text/plain"}))})}#a(){for(let t of this.root.querySelectorAll("[data-export]"))t.setAttribute("aria-pressed",String(t.dataset.export===this.exported));this.exported?this.asked=this.lab.link.ask("export",{setting:this.lab.setting.value}):this.texts({})}texts(t){let e=this.#t(".export"),i=t[this.exported],n=e.hidden;e.hidden=!i,!e.hidden&&(e.querySelector("textarea").value=i,n&&e.scrollIntoView({block:"nearest"}),e.querySelector(".save").download=this.exported==="toml"?"flight.toml":"flight.py")}setting(t){this.#t(".undo").disabled=!this.lab.setting.past.length,this.#t(".redo").disabled=!this.lab.setting.future.length;for(let n of this.selects){let[r,o]=n.dataset.path.split(".");n.value=t[r]?.[o]??this.lab.offer.first[r][o]??n.options[0].value,o==="sensors"&&(n.disabled=t.plant?.base==="ideal")}let e=t.start.y;if(e){let n=Math.hypot(e[0],e[1]),r=l=>+(l*180/Math.PI).toFixed(1),o=r(Math.atan2(n,e[2])),a=n>1e-6?r(Math.atan2(e[1],e[0])):this.rod[1].facts.value;[o,a].forEach((l,c)=>this.rod[c].show({...this.rod[c].facts,value:l}))}this.exported&&this.#a();let i=t.pokes??[];this.#t(".unpoke").hidden=i.length===0||this.lab.running.on,this.#t(".poke small").textContent=i.length?`at ${i.map(n=>n.time.toFixed(1)).join(", ")} s`:""}flight({sliders:t}){this.sliders(t),this.able(this.lab.running.able),this.complain("","")}sliders(t){for(let[e,i]of Object.entries(this.groups))i.show(t.filter(n=>n.group===e));for(let e of Xu)this.#t(`.has-${e}`).hidden=this.groups[e].sliders.length===0}fell(t){let i=this.groups.defects.sliders.filter(({facts:n})=>n.value>0).map(({facts:n,output:r})=>`${n.words} ${r.textContent}`).join(", ");this.#t(".fell").textContent=t&&i&&`${t} at ${i}.`}complain(t,e,i){for(let u of this.root.querySelectorAll(".complaint"))u.remove();if(!t)return;let n=[...this.root.querySelectorAll("[data-path]")],r=n.find(u=>u.dataset.path===i),a=([e,i??""].every(u=>u.startsWith("law.gains."))?r:null)??n.find(u=>u.dataset.path===e||e.startsWith(`${u.dataset.path}.`))??r;if(!a)return;let l=document.createElement("p"),h=this.groups.gains.sliders.find(u=>u.root===a)?.bound()??"";Object.assign(l,{className:"complaint",textContent:h?`${t}. ${h}`:t,role:"alert"}),(a.closest("label")??a).after(l)}};var zm={path:"start.y.tilt",words:"rod from upright",unit:"\xB0",low:0,high:180},Ec=class{constructor(t,e,i){Object.assign(this,{steps:e,lab:i,now:null}),this.root=document.createElement("section"),this.root.className="story",this.root.innerHTML=`<h2>How it works <small>chapter</small></h2><div class="chips" data-whose="Chapter"></div>
      <div class="step" hidden aria-live="polite"><h3></h3><p></p><div class="drag"></div><button type="button" class="next"></button></div>`,t.append(this.root);let n=r=>this.root.querySelector(r);Object.assign(this,{step:n(".step"),title:n("h3"),words:n("p"),next:n(".next")}),this.drag=new Zs(n(".drag"),(r,o)=>this.#t(r,o)),this.buttons=e.map(({title:r},o)=>{let a=document.createElement("button");return Object.assign(a,{type:"button",textContent:o+1,title:r}),a.setAttribute("aria-label",`Chapter ${o+1}: ${r}`),a.addEventListener("click",()=>this.go(o)),n(".chips").append(a),a}),this.next.addEventListener("click",()=>this.go(this.now+1)),this.#e()}get told(){return this.now!==null}go(t){this.lab.tell(this.steps[t]),this.now=t,this.drag.show([]),this.#e()}changed(t){this.now===null||Be(t)===Be(this.steps[this.now].setting)||(this.now=null,this.#e())}flown(t,e){let i=this.steps[this.now];if(!i)return;let[n,r,o]=t.start.y,a=Math.atan2(Math.hypot(n,r),o)*180/Math.PI;this.drag.show([{...zm,value:+a.toFixed(1)},...e].filter(({path:l})=>l===i.drag))}#t(t,e){t.path===zm.path?this.lab.rod([Math.sin(e*Math.PI/180),0,Math.cos(e*Math.PI/180)]):this.lab.slide(t,e)}#e(){let t=this.steps[this.now];if(this.buttons.forEach((i,n)=>i.setAttribute("aria-pressed",String(n===this.now))),this.step.hidden=!t,!t)return;this.title.textContent=t.title,this.words.textContent=t.words;let e=this.steps[this.now+1];this.next.hidden=!e,this.next.textContent=e&&`Next: ${e.title}`}};var WS=250,XS=.02,qS=.005,$S=.25,YS=.15,ZS=400,Ac=class{constructor(t,e){this.offer=t.offer,this.link=e(n=>this.#h(n),n=>this.#n(n)),this.viewer=new $s({...t,runs:[]},Io+vd),this.pinned=t.runs,this.main=document.querySelector("main"),this.main.classList.add("lab"),this.setting=new Mo(t.offer.first,()=>this.changed(),n=>this.#a(n)),Object.assign(this,{asked:0,shown:0,clock:new Map,times:[],tab:"flight"}),this.#i(),this.running=new zo(this),this.panel=new wc(this.main,this);let i=this.#t();this.offer.story?.length&&(this.story=new Ec(this.panel.bar,i?[{...i,phase:null}]:this.offer.story,this)),this.handle=new bc(this.viewer,n=>this.rod(n),n=>(this.kiosk??this.running).pull(n)),this.disc=new Sc(this.main,n=>{this.rod(n),this.show("flight")}),this.viewer.drew=()=>{this.handle.show(this.running.on,this.running.pulling),this.kiosk?.frame()},this.saving=new $o(this),Do({p:()=>this.panel.poke("bob"),l:()=>this.running.toggle(),r:()=>this.restart(),k:()=>this.exhibit(),Escape:()=>this.kiosk&&this.exhibit()}),this.#r(),Zc()!==null&&(this.kiosk=new sr(this,{quiet:Zc()})),this.setting.unreadable&&this.#s("The address holds no setting that can be read. This is the usual start."),i?this.#e():this.offer.chapters&&!location.hash?this.story.go(0):this.changed()}#t(){let t=new URLSearchParams(location.search).get("figure"),e=t&&[...this.offer.story??[],...this.offer.figures??[]].find(i=>i.name===t);return e?(this.main.classList.add("figure"),this.viewer.only=e.plot,e):null}#e(){let{clock:t}=this.viewer;new IntersectionObserver(([{isIntersecting:e}])=>{e&&!this.story.told?this.story.go(0):this.viewer.opening&&(e?t.play():t.pause())},{threshold:.5}).observe(this.main)}#i(){let t=this.main.querySelector("header");this.tabs=new Li(t,"View",[["flight","Flight","The flight and its plots"],["map","Region of attraction","From which directions of the rod it settles"]],e=>this.show(e)),this.words=document.createElement("p"),Object.assign(this.words,{className:"verdict",ariaLive:"polite"}),t.append(this.words),this.busy=document.createElement("p"),Object.assign(this.busy,{className:"busy",role:"status",textContent:"starting\u2026"}),this.viewer.parts.scene.append(this.busy),this.note=document.createElement("p"),Object.assign(this.note,{className:"notice",hidden:!0}),this.note.setAttribute("role","alert"),this.viewer.parts.scene.append(this.note),this.tabs.show("flight")}#n(t){this.busy.textContent=t,this.busy.hidden=!t}#s(t,[e,i]=[]){if(this.note.textContent=t,this.note.hidden=!t,!e)return;let n=document.createElement("button");Object.assign(n,{type:"button",textContent:e}),n.addEventListener("click",i),this.note.append(" ",n)}#r(){document.addEventListener("keydown",t=>{!(t.ctrlKey||t.metaKey)||t.key.toLowerCase()!=="z"||t.target.closest("textarea")||(t.preventDefault(),t.shiftKey?this.setting.redo():this.setting.undo())})}slide(t,e){this.touched=t.path,this.running.on||this.#o(),this.setting.slide(t,e)}#o(){let{stage:t}=this.viewer;t?.hold("slider",!0),clearTimeout(this.held),this.held=setTimeout(()=>{t?.hold("slider",!1),this.viewer.wake()},ZS)}choose(t,e){this.touched=t,this.running.go(!1);let i=structuredClone(this.setting.value),{mount:n}=i.vehicle;t==="law.name"?i.law={name:e,gains:{}}:t==="vehicle.mount"?i.vehicle.mount=e:t==="vehicle.base"?Object.assign(i,{vehicle:{base:e,mount:n},law:{name:i.law.name,gains:{}}}):t==="plant.sensors"?i.plant=qu(i.plant,e):i.plant=qu({base:e},i.plant.sensors),this.setting.replace(i)}reset(t){let e=structuredClone(this.setting.value);t==="gains"?e.law.gains={}:t==="place"?delete e.origin:t==="defects"?delete e.plant.defects:Object.assign(e,{plant:{...qu({base:e.plant.base},e.plant.sensors),...jS(e.plant)},vehicle:{base:e.vehicle.base,mount:e.vehicle.mount}}),this.setting.replace(e)}start(t){this.touched="start.y.tilt",this.running.on||(this.viewer.clock.pause(),this.viewer.clock.seek(this.viewer.clock.start)),this.setting.replace({...this.setting.value,start:t,pokes:[]}),this.running.restart()}restart(){this.running.on?this.running.restart():this.preset(this.offer.first)}pin(){this.record&&(this.pinned=this.pinned.length?[]:[{...this.record,title:"pinned"}],this.panel.pins(this.pinned.length>0),this.running.on||this.#m())}rod(t){this.start({...this.setting.value.start,y:ui(t)})}preset(t){this.running.go(!1),this.viewer.clock.pause(),this.viewer.clock.seek(this.viewer.clock.start),this.steady=null,this.setting.replace(t)}repeat(){this.again=!0,this.preset(this.setting.value)}#a(t){this.again=this.running.on,this.again?this.preset(t):this.setting.replace(t)}exhibit(){if(this.kiosk){this.kiosk.end(),this.kiosk=null,document.fullscreenElement&&document.exitFullscreen();return}this.running.able&&(this.show("flight"),this.panel.tune(!1),this.main.requestFullscreen?.().catch(()=>{}),this.kiosk=new sr(this,{leave:()=>this.exhibit()}))}tell({setting:t,phase:e}){this.show("flight"),this.follow=!0,this.preset(t),this.phase=e,this.viewer.clock.setSpeed(e?$S:1)}#l(){let{clock:t,flights:[e]}=this.viewer,i=e.phases.find(({name:n})=>n===this.phase)?.from;i!==void 0&&t.seek(i-YS),this.phase=null}poke(t,e,i){let{clock:n,stage:r}=this.viewer,{right:o=[1,0,0],back:a=[0,-1,0]}=r?.views[0]??{},l=ui([a[0],a[1],0]),[c,h]={right:[1,o],left:[-1,o],away:[-1,l],towards:[1,l],up:[1,[0,0,1]],down:[-1,[0,0,1]]}[e];if(this.running.on){this.running.poke(t,h.map(f=>c*i*f));return}let u=Math.max(n.time,0),d=(this.setting.value.pokes??[]).filter(f=>f.time<u-1e-9);this.touched="pokes.velocity",this.follow=!0,this.setting.replace({...this.setting.value,pokes:[...d,{time:u,on:t,velocity:h.map(f=>c*i*f)}]})}unpoke(){this.setting.replace({...this.setting.value,pokes:[]})}show(t){t==="map"&&this.running?.go(!1),this.tab=t,this.main.dataset.tab=t,this.disc.root.hidden=t!=="map",this.tabs.show(t),t==="map"?this.#c():(clearTimeout(this.mapping),this.link.ask("stop"))}changed(){if(this.panel.setting(this.setting.value),this.story?.changed(this.setting.value),this.running.on){this.running.follows(this.setting.value)?this.running.change():this.running.go(!1);return}this.asked=this.link.ask("fly",{setting:this.setting.value}),this.clock.set(this.asked,performance.now()),this.tab==="map"&&this.#c()}#c(){let{duration:t,start:e}=this.setting.value;this.disc.clear(t,e.y),this.mapped=-1,clearTimeout(this.mapping),this.mapping=setTimeout(()=>this.mapped=this.link.ask("map",{setting:this.setting.value}),WS)}#h(t){t.kind==="flight"?this.#u(t):t.kind==="preview"?this.#d(t):t.kind==="able"?this.#_():t.number===this.panel.asked?this.panel.texts(t):t.kind==="map"&&t.number===this.mapped?this.disc.add(t):t.kind==="compiling"&&t.number>=this.shown?this.#n("compiling\u2026"):t.kind==="error"&&t.number===this.asked?this.#v(t):t.kind==="error"&&t.number===this.mapped&&this.disc.refuse(t.message)}#u(t){t.number<this.shown||(this.shown=t.number,t.number>(this.previewed??0)&&this.#p(t),this.verdict=t.verdict,Bn(this.words,t.verdict),t.number===this.asked&&(this.#n(""),this.adopt(t.start),this.panel.flight(this.running.on?{...t,sliders:this.link.sliders(this.setting.value)}:t),this.running.on||this.panel.fell(t.verdict.good?"":"Fails"),this.#g(),this.viewer.stage&&t.verdict.part&&this.viewer.flights[0].end<XS&&this.#s(`${JS(t.verdict.reason)} at the start. Shaded directions are taken.`,["Move to a free start",()=>this.free()]),this.story?.flown(this.setting.value,t.sliders),this.phase&&this.#l(),this.follow&&!Ni()&&this.viewer.clock.play(),this.follow=!1,this.again&&this.#f()))}#f(){this.again=!1,this.viewer.clock.seek(this.viewer.clock.start),this.viewer.open(()=>this.#x())}#d(t){t.number<=this.shown||t.number<(this.previewed??0)||this.running.on||(this.previewed=t.number,this.#p(t),Bn(this.words,t.verdict))}#p(t){let e=!this.flew;e&&performance.mark("flypend flown"),(!e||this.main.classList.contains("stale"))&&this.#s(""),this.main.classList.remove("stale"),this.flew=!0,this.steady??=t.run.direction,this.record={...t.run,direction:this.steady},this.running.on||this.#m(),e&&this.#f(),this.disc.follow(this.viewer.flights[0]);let i=this.clock.get(t.number);for(let r of this.clock.keys())r<=t.number&&this.clock.delete(r);if(i===void 0)return;let n=performance.now()-i;requestAnimationFrame(()=>{e&&performance.mark("flypend drawn"),this.times=[...this.times.slice(-199),{here:t.kind==="preview",flown:t.milliseconds,ready:n,picture:performance.now()-i}]})}#x(){return!this.story?.told&&this.running.able&&this.record.e3==="up"&&this.running.go(!0),this.running.on}get usual(){return JSON.stringify(this.setting.value)===JSON.stringify(this.offer.first)}get ghosts(){return this.offer.vehicles||!this.usual||this.pinned[0]?.title==="pinned"?this.pinned:[]}#m(){this.viewer.load([this.record,...this.ghosts])}#_(){this.panel.able(this.running.able),this.#g()}#g(){let{value:t}=this.setting,{stage:e}=this.viewer,i=JSON.stringify([Be(t),t.start.R]);!e||!this.record||!this.running.able||i===this.barred||(this.barred=i,this.record.vehicle.mount==="gimbal"?e.barred.take([]):this.link.clear(t,e.barred.directions,n=>{e.barred.take(n),this.viewer.wake()}))}free(){let{value:t}=this.setting,{directions:e}=this.viewer.stage.barred;this.link.clear(t,e,i=>{let n=e.filter((r,o)=>i[o]>qS).sort((r,o)=>ye(o,t.start.y)-ye(r,t.start.y));n.length&&this.rod(n[0])})}adopt(t){Ks(this.setting.value.start)||(this.setting.adopt(t),this.panel.setting(this.setting.value))}#v({number:t,field:e,message:i}){if(this.shown=t,this.follow=!1,this.#n(""),this.panel.complain(i,e,this.touched),this.verdict={words:i,good:!1,state:"failed"},Bn(this.words,{words:"not flown",state:"failed"}),this.viewer.clock.pause(),!this.flew&&!this.usual)this.#y(i);else{this.main.classList.add("stale");let n=this.setting.past.length?["Undo",()=>this.setting.undo()]:[];this.#s(`Not flown. ${i}.${this.flew?" The picture is of the last flight.":""}`,n)}}#y(t){this.#s(`The setting of the address cannot be flown (${t}). This is the usual start.`),this.setting.replace(this.offer.first)}provide(){let t=e=>(...i)=>(this.viewer.take(),e(...i));return Object.freeze({...this.viewer.offer(),setting:()=>structuredClone(this.setting.value),verdict:()=>this.verdict,number:()=>this.asked,shown:()=>this.shown,timings:()=>structuredClone(this.times),tab:t(e=>this.show(e)),live:()=>this.running.told(),go:t(e=>this.running.go(e)),poke:t((e,i)=>this.running.poke(e,i)),pull:t(e=>this.running.pull(e)),pin:()=>this.pin(),map:()=>({total:this.disc.total,done:this.disc.points.length,good:this.disc.good,points:structuredClone(this.disc.points),path:this.disc.path})})}},JS=s=>s[0].toUpperCase()+s.slice(1),jS=({defects:s})=>s?{defects:s}:{};function qu({noise:s,sensors:t,defects:e,...i},n){return n&&n!=="perfect"?{...i,sensors:n}:{...i,...s&&{noise:s}}}var Tc=class{constructor({engines:t,offer:e},i){Object.assign(this,{engines:t,offer:e,told:i,number:0,opened:new Map,local:null})}ask(t,e={}){let i=++this.number,n=t==="stop"?"":this.#t(e.setting);return n?queueMicrotask(()=>this.told({kind:"error",number:i,field:"",message:`this page cannot fly ${n}; flypend lab can`})):this.local?.ask(t,e,i),i}#t(t){let e=Be(t),i=Object.hasOwn(this.engines,e)&&this.engines[e],n=i?Qs(t,i.engine):e,r=n?null:this.opened.get(e)??this.#e(i);return this.local&&this.local!==r&&this.local.ask("stop"),r&&er(this.opened,e,r),this.local=r,n}#e({engine:t,sliders:e,record:i}){return new dn({engine:t,offer:{...this.offer,sliders:e,seed:0},runs:[i]},this.told)}get facts(){return this.local?.facts}rebuilds(t){return!!Qs(t,this.facts)}begin(t,e,i){this.local.begin(t,e,i)}advance(t){this.local.advance(t)}clear(t,e,i){this.local.clear(t,e,i)}whole(t){return this.local.whole(t)}sliders(t){return this.local.sliders(t)}};var is=JSON.parse(document.getElementById("flypend-data").textContent);function KS(s,t){return is.engines?new Tc(is,s):is.engine?new dn(is,s):new Co(s,t)}if(is.offer)window.flypend=new Ac(is,KS).provide();else{let s=new $s(is);window.flypend=s.offer(),s.open()}})();
